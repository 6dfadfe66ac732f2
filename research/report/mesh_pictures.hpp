// Pictures of meshes as one SVG file: all at one scale, side by side or below each other, readable on light and dark pages.
#pragma once
#include <research/study/mesh_picture.hpp>

#include <span>
#include <string>

namespace plastron::study {

/// A complete SVG file; empty where there is nothing to draw. Plain text in captions.
std::string svg_of_meshes(std::span<const MeshPicture> pictures);

}  // namespace plastron::study
