// Counts allocations by replacing the operators new and delete of a test program. Include it in one file of a program.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace {

int allocations_made = 0;
std::size_t largest_allocation = 0;

}  // namespace

void* operator new(std::size_t bytes) {
  ++allocations_made;
  largest_allocation = std::max(largest_allocation, bytes);
  if (void* memory = std::malloc(std::max<std::size_t>(bytes, 1))) return memory;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, const std::nothrow_t& /*tag*/) noexcept {
  try {
    return operator new(size);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace plastron::test {

/// Counts from its construction on; only one may exist at a time.
class Allocations {
 public:
  Allocations() { largest_allocation = 0; }
  int count() const { return allocations_made - before_; }
  std::size_t largest_bytes() const { return largest_allocation; }

 private:
  int before_ = allocations_made;
};

}  // namespace plastron::test
