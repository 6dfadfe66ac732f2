#include <plastron/geometry/given_function.hpp>

#include <map>
#include <mutex>
#include <utility>

namespace plastron::geometry {

namespace {

struct Names {
  std::mutex mutex;
  std::map<std::string, std::shared_ptr<const GivenFunction>, std::less<>> functions;
};

Names& names() {
  static Names only;
  return only;
}

}  // namespace

void give_function(const std::string& name, GivenFunction function) {
  const std::lock_guard lock(names().mutex);
  names().functions[name] = std::make_shared<const GivenFunction>(std::move(function));
}

void forget_function(const std::string& name) {
  const std::lock_guard lock(names().mutex);
  names().functions.erase(name);
}

std::shared_ptr<const GivenFunction> given_function(std::string_view text) {
  const std::lock_guard lock(names().mutex);
  const auto found = names().functions.find(text);
  return found == names().functions.end() ? nullptr : found->second;
}

}  // namespace plastron::geometry
