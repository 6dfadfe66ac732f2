// The list of all statuses of a contact problem.
#pragma once
#include <plastron/contact/problem.hpp>

#include <span>

namespace plastron::contact {

std::span<const Status> statuses();

}  // namespace plastron::contact
