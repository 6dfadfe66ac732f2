// The point that the moments of a summary are about: users take those of a hinge or a bearing about its axis.
#pragma once
#include <plastron/certificate/certificate.hpp>

namespace plastron::certificate {

/// All moments in `summary`, those of contact zones included, become those about `point` [m]. The certificate's balance stays about the origin.
void take_moments_about(const Vector3d& point, Summary& summary);

}  // namespace plastron::certificate
