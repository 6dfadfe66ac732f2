// All the ways in which a contact problem ends, for who lists them.
#pragma once
#include <plastron/contact/problem.hpp>

#include <span>

namespace plastron::contact {

std::span<const Status> statuses();

}  // namespace plastron::contact
