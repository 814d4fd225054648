#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace plaza::drawing {

struct Tile {
  cv::Mat image;  ///< 8-bit BGR, not empty
  std::string name, caption;
};

/// Tiles that belong together: a view's.
struct Section {
  std::string title;
  std::vector<Tile> tiles;
};

/// All tiles in one picture, section by section in rows of at most `columns`, each with its name
/// and caption below. `width_px` >= 320; the height follows. Images are scaled to the tiles' width,
/// but not enlarged beyond `most_enlarged` times their size.
cv::Mat contact_sheet(const std::string& title, const std::vector<Section>& sections, int width_px,
                      int columns, double most_enlarged = 2);

}  // namespace plaza::drawing
