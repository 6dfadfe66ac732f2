// plastron explain: the manual for one word, from the declarations of the program.
#include "inquiries.hpp"
#include "terminal.hpp"
#include "topic.hpp"

#include <plastron/config/nearest.hpp>

#include <algorithm>
#include <iterator>

namespace plastron::app {

namespace {

std::vector<Topic> all_topics() {
  std::vector<Topic> all = case_topics();
  for (std::vector<Topic> more : {result_topics(), limit_topics()}) std::ranges::move(more, std::back_inserter(all));
  return all;
}

/// Returns "obstacle.ball" for "[[obstacle]].ball", "obstacle[0].ball" and "obstacle[].ball"; "shell" for "[shell]".
std::string plain_word(const std::string& word) {
  std::string result;
  std::string_view rest = word;
  while (rest.starts_with('[')) rest.remove_prefix(1);
  bool in_index = false;
  for (const char c : rest) {
    in_index = (in_index || c == '[') && c != ']';
    if (!in_index && c != ']') result += c;
  }
  return result;
}

std::string last_part(const std::string& name) { return name.substr(name.rfind('.') + 1); }

ExitCode refuse(const std::string& word, const std::vector<Topic>& topics) {
  std::vector<std::string> known;
  for (const Topic& topic : topics) {
    known.push_back(topic.name);
    known.push_back(last_part(topic.name));
    known.insert(known.end(), topic.aliases.begin(), topic.aliases.end());
  }
  std::ranges::sort(known);
  known.erase(std::unique(known.begin(), known.end()), known.end());
  constexpr std::size_t most = 5;
  const auto near = config::nearest_few(word, known, most);
  const std::string advice = near.empty() ? "" : fmt::format("did you mean {}? ", fmt::join(near, ", "));
  print_error("error: nothing is called \"{}\"; {}plastron explain lists what there is\n", word, advice);
  return bad_input;
}

void print_topic(const Topic& topic, bool is_first) {
  if (is_first_rank()) print_text(stdout, fmt::format("{}{}: {}\n", is_first ? "" : "\n", topic.name, topic.what));
  if (is_first_rank()) print_text(stdout, topic.text());
}

}  // namespace

bool Topic::is_called(const std::string& word) const {
  return name == word || std::ranges::find(aliases, word) != aliases.end();
}

std::vector<std::string> explained_words() {
  std::vector<std::string> words;
  for (const Topic& topic : all_topics()) words.push_back(plain_word(topic.name));
  std::ranges::sort(words);
  words.erase(std::unique(words.begin(), words.end()), words.end());
  return words;
}

ExitCode explain(const std::string& given) {
  if (given.empty()) {
    if (is_first_rank())
      print_text(stdout, case_overview() + "\n" + result_overview() + "\n" + limit_overview() +
                             "\nplastron explain WORD tells of each of them.\n");
    return solved;
  }
  const std::string word = plain_word(given);
  const std::vector<Topic> topics = all_topics();
  bool is_first = true;
  for (const bool in_full : {true, false})
    for (const Topic& topic : topics)
      if (in_full ? topic.is_called(word) : !topic.is_called(word) && topic.ends_with(word)) {
        print_topic(topic, is_first);
        is_first = false;
      }
  return is_first ? refuse(given, topics) : solved;
}

}  // namespace plastron::app
