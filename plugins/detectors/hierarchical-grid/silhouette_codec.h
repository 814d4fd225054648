#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "plaza/geometry/silhouette.h"

namespace plaza {

/// Appends the silhouette to `bytes`, about 6 bytes per contour point: positions are rounded to
/// 1/64 px, normals to 1/65536 of a turn.
void encode(const Silhouette& silhouette, std::string& bytes);

/// Reads one silhouette and moves `at` behind it. Throws Error when the bytes are no silhouette.
Silhouette decode(std::string_view bytes, std::size_t& at);

}  // namespace plaza
