// Extreme files are refused at once, in one message, however expensive they would be to read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>
#include <plastron/config/case.hpp>
#include <plastron/config/schema.hpp>

#include <ctime>
#include <filesystem>
#include <fstream>

namespace plastron::config {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr double at_once = 1;  // [s] of the processor, so that a busy machine does not matter

template <class Read>
std::string refusal_of(const Read& read) {
  const std::clock_t start = std::clock();
  std::string text;
  try {
    read();
  } catch (const CaseErrors& errors) {
    text = errors.format();
  }
  EXPECT_LT(double(std::clock() - start) / CLOCKS_PER_SEC, at_once);
  EXPECT_LT(text.size(), 20000u);
  return text;
}

std::string refusal(const std::string& text) {
  return refusal_of([&] { parse_case(text, "case.toml"); });
}

std::string repeated(const std::string& part, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += part;
  return text;
}

std::string case_with(const std::string& chart, const std::string& domain = "disk = { radius = 1 }",
                      const std::string& more = "", const std::string& thickness = "0.1") {
  return more + "[shell]\nE = 1\nnu = 0\nthickness = " + thickness + "\n[geometry]\ndomain = { " + domain +
         " }\nchart = [\"x\", \"y\", \"" + chart + "\"]\n";
}

// ---- what the program cannot do ----------------------------------------------------------------------------------------

/// Words of other programs, as sections and as keys: each names its row of docs/limits.md and what to do.
TEST(UnknownWord, OfSpringsFrictionPointLoadsAndCasesNamesTheLimitAndWhatToDo) {
  struct Words {
    const char* limit;
    std::vector<std::string> sections, keys;
    const char* advice;
  };
  const std::vector<Words> all{
      {"springs",
       {"springs", "foundations", "elastic_foundation", "elastic_support", "bed", "elastic_bed", "bedding", "winkler",
        "subgrade"},
       {"[shell] foundation", "[shell] bed", "[[support]] spring", "[[support]] stiffness", "[[support]] elastic",
        "[[obstacle]] spring", "[[obstacle]] stiffness", "[[spring]] rigid_body", "[[spring]] boundary",
        "[[rigid_body]] stiffness", "[[rigid_body]] spring"},
       "`[[spring]]` at a point"},
      {"temperature", {"thermal", "heat"}, {"[shell] temperature", "[[load]] temperature"}, "`[[temperature]]`"},
      {"free-bodies", {"free_body", "unsupported"}, {"[shell] free", "[[support]] free_free"}, "for frequencies of a"},
      {"load-cases", {"load_case", "load_cases", "loadcases", "combinations"}, {}, "`[[case]]` and `[[envelope]]`"},
      {"friction",
       {"friction", "coulomb", "friction_coefficient"},
       {"[[obstacle]] friction", "[[obstacle]] mu", "[contact] friction", "[[support]] friction",
        "[[obstacle]] friction_coefficient"},
       "supports instead of friction"},
      {"point-loads",
       {"force", "forces", "moment", "point_load", "point_loads", "point_force", "nodal_load", "nodal_forces",
        "concentrated_load", "concentrated_force"},
       {"[[load]] at", "[[load]] node", "[[load]] nodes", "[[load]] point_load"},
       "`point`, `radius` and `total`"}};
  for (const auto& [limit, names, keys, advice] : all) {
    const auto says = AllOf(HasSubstr("unknown"), HasSubstr(std::string("(docs/limits.md, ") + limit + ")"),
                            HasSubstr(std::string("Instead: ") + advice));
    for (const std::string& name : names)
      for (const std::string& header : {"[" + name + "]", "[[" + name + "]]"})
        EXPECT_THAT(refusal(case_with("0") + header + "\nk = 1\n"), says) << header;
    for (const std::string& key : keys) {
      const auto space = key.find(' ');
      const std::string header = key.substr(0, space), line = key.substr(space + 1) + " = 1\n";
      const std::string text = header == "[shell]" ? case_with("0", "disk = { radius = 1 }", "", "0.1\n" + line)
                                                   : case_with("0") + header + "\n" + line;
      EXPECT_THAT(refusal(text), says) << key;
    }
  }
}

// ---- nesting ---------------------------------------------------------------------------------------------------------

TEST(Nesting, ThatIsTooDeepIsRefusedBeforeTheParserDescends) {
  for (const int depth : {21, 3440, 5900, 100000}) {
    const std::string lists = repeated("[", depth) + repeated("]", depth);
    EXPECT_THAT(refusal("title = " + lists), HasSubstr("nested deeper than 20"));
    EXPECT_THAT(refusal("title = " + repeated("{a=", depth) + "1" + repeated("}", depth)), HasSubstr("nested deeper"));
    EXPECT_THAT(refusal("a" + repeated(".a", depth) + " = 1"), HasSubstr("nested deeper"));
    EXPECT_THAT(refusal("[a" + repeated(".\"b\"", depth) + "]"), HasSubstr("nested deeper"));
    EXPECT_THAT(refusal("title = " + repeated("[", depth)), HasSubstr("nested deeper"));
    EXPECT_THAT(refusal("# \"\n'" + repeated("\\'", 3) + "\nx = " + lists), HasSubstr("case.toml:"));
  }
}

TEST(Nesting, InTextsAndCommentsDoesNotCount) {
  const std::string brackets = repeated("[{.", 50);
  for (const std::string& title :
       {"\"" + brackets + "\\\"" + brackets + "\"", "'" + brackets + "'", "'''" + brackets + "''\n" + brackets + "'''",
        "\"\"\"" + brackets + "\\\"\"\"\n\"" + brackets + "\"\"\" # " + brackets})
    EXPECT_EQ(refusal("title = " + title + "\n" + case_with("0")), "") << title;
}

TEST(Nesting, OfAnExpressionIsLimited) {
  for (const int depth : {60, 1900, 5900}) {
    const std::string deep = repeated("(", depth) + "x" + repeated(")", depth);
    EXPECT_THAT(refusal(case_with(deep)), AllOf(HasSubstr("error"), HasSubstr("case.toml:7:")));
    EXPECT_THAT(refusal(case_with("0", "disk = { radius = \"" + deep + "\" }")), HasSubstr("error"));
    EXPECT_THAT(refusal(case_with("0", "disk = { radius = 1 }", "", "\"" + deep + "\"")), HasSubstr("error"));
  }
  for (const std::string sign : {"-", "+", "x?", "!"})
    EXPECT_THAT(refusal(case_with(repeated(sign, 900) + "x")), HasSubstr("error"));
  for (const std::string sign : {"2^", "x^", "x^-"})
    EXPECT_THAT(refusal(case_with(repeated(sign, 900) + "x")), AllOf(HasSubstr("error"), HasSubstr("in each other")));
  EXPECT_EQ(refusal(case_with(repeated("(", 40) + "x" + repeated(")", 40))), "");
}

// ---- sizes -----------------------------------------------------------------------------------------------------------

TEST(Size, OfAFileIsLimited) {
  const fs::path path = fs::temp_directory_path() / ("plastron-large-" + std::to_string(getpid()) + ".toml");
  std::ofstream(path) << std::string(largest_file + 1, '#');
  EXPECT_THAT(refusal_of([&] { read_case(path); }), HasSubstr("larger than 256 kB"));
  fs::remove(path);
}

TEST(Size, OfListsAndTablesIsLimited) {
  std::string constants = "[constants]\n", corners, loads,
              support = "[[support]]\nboundary = \"rim\"\nfix = [\"u\"]\nvalues = { ";
  for (int i = 0; i < 9000; ++i) {
    constants += "c" + std::to_string(i) + " = " + std::to_string(i) + "\n";
    loads += "[[load]]\npressure = 1\n";
    support += "k" + std::to_string(i) + " = 1, ";
  }
  for (int i = 0; i < 3000; ++i) corners += "[" + std::to_string(i) + ", " + std::to_string(i * i) + "], ";
  EXPECT_THAT(refusal(case_with("0", "disk = { radius = 1 }", constants)), HasSubstr("more than 500 entries"));
  EXPECT_THAT(refusal(case_with("0") + loads), HasSubstr("more than 500 sections"));
  EXPECT_THAT(refusal(case_with("0") + support + "z = 1 }\n"), HasSubstr("more than 500 entries"));
  EXPECT_THAT(refusal(case_with("0", "polygon = [" + corners + "[0, -1]]")), HasSubstr("more than 500 entries"));
  std::string few;
  for (int i = 0; i < 499; ++i) few += "[" + std::to_string(i) + ", " + std::to_string(i * i) + "], ";
  EXPECT_EQ(refusal(case_with("0", "polygon = [" + few + "[0, 300000]]")), "");
  EXPECT_THAT(refusal(case_with("0", "polygon = [" + few + "[-1, 300000], [-1, 0]]")),
              AllOf(HasSubstr("501 entries"), HasSubstr("at most 500 entries")));
}

TEST(Size, OfTheCoarsestMeshIsLimited) {
  EXPECT_THAT(refusal(case_with("0", "rectangle = { to = [1, 1], cells = [10000, 10000] }")),
              AllOf(HasSubstr("10000 x 10000 cells"), HasSubstr("at most 1000000")));
}

TEST(Size, OfAnExpressionIsLimited) {
  for (const int terms : {700, 20000}) {
    const std::string sum = "1" + repeated(" + x*y", terms);
    EXPECT_THAT(refusal(case_with(sum)), AllOf(HasSubstr("characters long"), HasSubstr("at most 4000")));
    EXPECT_THAT(refusal(case_with("0", "disk = { radius = 1 }", "", "\"" + sum + "\"")), HasSubstr("characters long"));
  }
  EXPECT_EQ(refusal(case_with("1" + repeated(" + x*y", 600))), "");
}

TEST(Size, OfWhatIsReportedIsLimited) {
  std::string unknown;
  for (int i = 0; i < 400; ++i) unknown += "k" + std::to_string(i) + " = 1\n";
  EXPECT_THAT(refusal(unknown),
              AllOf(HasSubstr("more than 50 mistakes"), HasSubstr("\"k10\""), Not(HasSubstr("\"k70\""))));
}

// ---- formulas --------------------------------------------------------------------------------------------------------

TEST(Formula, WithNumbersThatFillTheMemoryIsRefused) {
  for (const std::string formula :
       {"9^9^9*x", "((9*x)^1000)^1000", "x*(2*y)^99999", "9^9^9^9", "x^1e300", "(x+1)^-123456", "2^(3^700)*x"})
    EXPECT_THAT(refusal(case_with(formula)), AllOf(HasSubstr("entry 3 of chart"), HasSubstr("error"))) << formula;
  EXPECT_EQ(refusal(case_with("1e-9*(x^4 + 2^10*y^12)/7^3 + (1 + x)^-3.5")), "");
}

TEST(Formula, WhoseDerivativesAreTooLongIsRefused) {
  std::string product = "x", nested = "x", tower = "x";
  for (int i = 0; i < 300; ++i) product += "*(x+" + std::to_string(i) + ")";
  for (int i = 0; i < 45; ++i) nested = "sin(" + nested + "*x+y)";
  for (int i = 0; i < 150; ++i) tower += "^x";
  for (const std::string& formula : {product, nested, tower})
    EXPECT_THAT(refusal(case_with(formula)), AllOf(HasSubstr("cannot be differentiated twice"), HasSubstr("too long")));
  EXPECT_EQ(refusal(case_with("(x+1)*(x+2)*(y+3)*(y+4)*(x*y+5)*sin(x)*cos(exp(-x^2-y^2))*sqrt(4+x*y)")), "");
}

TEST(Formula, KnowsTheFunctionsThatTheManualLists) {
  EXPECT_EQ(refusal(case_with("ln(2+x) + log(2+y) + asinh(x) + acosh(2+x) + atanh(x/4)")), "");
  EXPECT_THAT(refusal(case_with("sign(x)")), HasSubstr("cannot be differentiated twice: \"sign\" has no derivatives"));
  EXPECT_EQ(refusal(case_with("0", "disk = { radius = 1 }", "", "\"2 + sign(x) + min(ln(3+x), max(x, y))\"")), "");
  for (const std::string name : {"log10", "log2", "sum", "avg", "rint", "step", "sq"})
    EXPECT_THAT(refusal(case_with("0", "disk = { radius = 1 }", "", "\"2 + " + name + "(2+x)\"")),
                HasSubstr("unknown name \"" + name + "\""));
}

// ---- numbers ---------------------------------------------------------------------------------------------------------

TEST(Number, BeyondWhatCanBeComputedWithIsRefused) {
  EXPECT_THAT(refusal(case_with("0") + "[[load]]\nforce = [0, 0, -1e200]\n"),
              HasSubstr("is -1e+200, which is too large"));
  EXPECT_THAT(refusal(case_with("0") + "[[load]]\npressure = \"1e99*1e99\"\n"), HasSubstr("too large to compute with"));
  EXPECT_THAT(refusal(case_with("0", "disk = { radius = 1 }", "", "1e-200")), HasSubstr("too small to compute with"));
  EXPECT_EQ(refusal(case_with("0") + "[[load]]\nforce = [0, 0, \"sin(pi)^9\"]\n"), "");
}

TEST(PoissonsRatio, NearMinusOneIsRefused) {
  const std::string rest =
      "thickness = 0.1\n[geometry]\ndomain = { disk = { radius = 1 } }\nchart = [\"x\", \"y\", 0]\n";
  EXPECT_THAT(refusal("[shell]\nE = 1\nnu = -0.9999999999999999\n" + rest), HasSubstr("allowed: -0.999 <= nu < 0.5"));
  EXPECT_THAT(refusal("[shell]\nlambda = -0.6666\nmu = 1\n" + rest), HasSubstr("Poisson's ratio is -0.9997"));
  EXPECT_EQ(refusal("[shell]\nE = 1\nnu = -0.99\n" + rest), "");
  EXPECT_EQ(refusal("[shell]\nE = 1\nnu = 0.4999999\n" + rest), "");
}

// ---- names and quotations ----------------------------------------------------------------------------------------------

TEST(Name, IsShortAndHasNoControlCharacters) {
  for (const std::string name : {"a\\u001b[31m", "a\\tb", "a\\nb", "\\u007f", "\\u0085"}) {
    EXPECT_THAT(refusal(case_with("0") + "[[probe]]\nname = \"" + name + "\"\nat = [0, 0]\n"),
                HasSubstr("name has a control character"));
    EXPECT_THAT(refusal(case_with("0") + "[[support]]\nboundary = \"" + name + "\"\nfix = [\"u\"]\n"),
                HasSubstr("boundary has a control character"));
    EXPECT_THAT(refusal(case_with("0", "mesh = \"" + name + ".msh\"")), HasSubstr("has a control character"));
  }
  EXPECT_THAT(refusal(case_with("0") + "[[probe]]\nname = \"" + repeated("p", 61) + "\"\nat = [0, 0]\n"),
              HasSubstr("name is 61 bytes long"));
  EXPECT_THAT(refusal("[constants]\n" + repeated("c", 61) + " = 1\n" + case_with("0")), HasSubstr("at most 60"));
}

TEST(Quotation, IsShortAndPrintable) {
  const std::string long_word = repeated("w", 5000);
  for (const std::string& text :
       {case_with(long_word), case_with("0") + "[mesh]\ncells = \"" + long_word + "\"\n", long_word + " = 1\n",
        "[" + long_word + "]\n", "a = " + long_word + "\n", case_with("0") + "[mesh]\n\"" + long_word + "\" = 1\n",
        case_with("0") + "[[support]]\nboundary = \"rim\"\nfix = [\"u\", \"" + long_word + "\"]\nvalues = { " +
            long_word + " = 1 }\n"})
    EXPECT_THAT(refusal(text), AllOf(HasSubstr("error"), Not(HasSubstr(repeated("w", 110)))));
  const std::string message = refusal(case_with("0") + "[mesh]\n\"\\u001b]0;t\\u0007\\u009b31m\" = 1\n");
  for (const char* bad : {"\x1b", "\x07", "\xC2\x9B"}) EXPECT_THAT(message, Not(HasSubstr(bad)));
}

// ---- files that are no text files ---------------------------------------------------------------------------------------

struct Pipe {
  fs::path path = fs::temp_directory_path() / ("plastron-pipe-" + std::to_string(getpid()));
  Pipe() { EXPECT_EQ(mkfifo(path.c_str(), 0600), 0); }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  ~Pipe() { fs::remove(path); }
};

TEST(File, ThatIsAPipeADeviceOrADirectoryIsRefused) {
  const Pipe pipe;
  const auto refused = [](const fs::path& path) { return refusal_of([&] { read_case(path); }); };
  EXPECT_THAT(refused(pipe.path), HasSubstr("this is a pipe, not a case file"));
  EXPECT_THAT(refused("/dev/zero"), HasSubstr("this is a device, not a case file"));
  EXPECT_THAT(refused("/dev/null"), HasSubstr("this is a device"));
  EXPECT_THAT(refused("/"), HasSubstr("this is a directory"));
  for (const std::string& path : {pipe.path.string(), std::string("/dev/zero"), std::string("/")})
    EXPECT_THAT(refusal(case_with("0", "mesh = \"" + path + "\"")), HasSubstr("not a mesh file"));
}

}  // namespace
}  // namespace plastron::config
