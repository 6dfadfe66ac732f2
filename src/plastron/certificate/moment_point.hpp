// The reference point of a summary's moments: users want moments of a hinge or a bearing about its axis.
#pragma once
#include <plastron/certificate/certificate.hpp>

namespace plastron::certificate {

/// Refers all moments in `summary`, also of contact zones, to `point` [m]. The certificate's balance stays about the
/// origin.
void take_moments_about(const Vector3d& point, Summary& summary);

}  // namespace plastron::certificate
