// Who hears of the progress of a computation.
#pragma once
#include <plastron/study/result.hpp>

#include <functional>
#include <string_view>

namespace plastron::study {

/// Hears of progress; every member may be empty. Called on every rank.
struct Observer {
  std::function<void(int level, std::string_view phase)> phase{};
  std::function<void(int level, const contact::Iteration&)> iteration{};
  std::function<void(int level, const Level&)> level{};
  std::function<void(std::string_view text)> warning{};        ///< as soon as it is known; it also stands in the result
  std::function<void(int level, const Solution&)> solution{};  ///< of every level, which is gone afterwards
};

}  // namespace plastron::study
