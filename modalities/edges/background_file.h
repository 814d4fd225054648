#pragma once

#include <iosfwd>
#include <memory>
#include <vector>

#include "modalities/edges/background.h"

namespace plaza::edges {

/// Writes the backgrounds of all views, with the cameras' names and sizes and a checksum.
void save_backgrounds(std::ostream& out, const Scene& scene,
                      const std::vector<std::shared_ptr<const ViewBackground>>& views);

/// Reads them again. Throws UserError when the content is damaged, or of other cameras.
std::vector<std::shared_ptr<const ViewBackground>> load_backgrounds(std::istream& in,
                                                                    const Scene& scene,
                                                                    double tolerance_px);

}  // namespace plaza::edges
