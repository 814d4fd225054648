#include "plugins/sinks/drawing/contact_sheet.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "plugins/sinks/drawing/canvas.h"

namespace plaza::drawing {
namespace {

constexpr int kGap = 12, kText = 12, kTitle = 16;
constexpr int kLabel = 2 * kText + 26;      // a label with its room
constexpr int kHeader = kTitle + 2 * kGap;  // a title with its room

cv::Size fitted(cv::Size image, int width, double most_enlarged) {
  const double scale = std::min(most_enlarged, static_cast<double>(width) / image.width);
  return {std::max(1, static_cast<int>(std::lround(image.width * scale))),
          std::max(1, static_cast<int>(std::lround(image.height * scale)))};
}

/// The text, shortened until it fits.
std::string shortened(std::string text, double height_px, double room_px) {
  if (text_size(text, height_px).width <= room_px) return text;
  while (!text.empty() && text_size(text + "...", height_px).width > room_px) {
    text.pop_back();
  }
  return text + "...";
}

struct Row {
  std::size_t begin, end;
  int height;  ///< of its highest image
};

std::vector<Row> rows_of(const Section& section, int tile_width, std::size_t columns,
                         double most_enlarged) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < section.tiles.size(); i += columns) {
    Row row{i, std::min(i + columns, section.tiles.size()), 0};
    for (std::size_t t = row.begin; t < row.end; ++t) {
      row.height = std::max(
          row.height, fitted(section.tiles[t].image.size(), tile_width, most_enlarged).height);
    }
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

cv::Mat contact_sheet(const std::string& title, const std::vector<Section>& sections, int width_px,
                      int columns, double most_enlarged) {
  std::size_t most = 1;
  for (const Section& s : sections) most = std::max(most, s.tiles.size());
  const int used = std::min(columns, static_cast<int>(most));
  const int tile_width = (width_px - kGap) / used - kGap;
  int height = kHeader;
  for (const Section& section : sections) {
    height += kHeader;
    for (const Row& row :
         rows_of(section, tile_width, static_cast<std::size_t>(used), most_enlarged)) {
      height += row.height + kLabel;
    }
  }
  const Theme& theme = dark_theme();
  cv::Mat sheet(height + kGap, width_px, CV_8UC3, theme.paper);
  const double room = width_px - 2 * kGap;
  draw_text(sheet, shortened(title, kTitle, room), {kGap, kGap}, {kTitle, theme.text});
  int y = kHeader;
  for (const Section& section : sections) {
    draw_text(sheet, shortened(section.title, kTitle, room), {kGap, static_cast<double>(y + kGap)},
              {kTitle, theme.quiet_text});
    y += kHeader;
    for (const Row& row :
         rows_of(section, tile_width, static_cast<std::size_t>(used), most_enlarged)) {
      for (std::size_t t = row.begin; t < row.end; ++t) {
        const Tile& tile = section.tiles[t];
        const int x = kGap + static_cast<int>(t - row.begin) * (tile_width + kGap);
        const cv::Size size = fitted(tile.image.size(), tile_width, most_enlarged);
        cv::Mat place = sheet(cv::Rect({x, y}, size));
        cv::resize(tile.image, place, size, 0, 0,
                   size.width < tile.image.cols ? cv::INTER_AREA : cv::INTER_NEAREST);
        const auto write = [&](const std::string& text, int top, const Color& color) {
          draw_text(sheet, shortened(text, kText, tile_width),
                    {static_cast<double>(x), static_cast<double>(y + size.height + top)},
                    {kText, color});
        };
        write(tile.name, 6, theme.text);
        write(tile.caption, kText + 12, theme.quiet_text);
      }
      y += row.height + kLabel;
    }
  }
  return sheet;
}

}  // namespace plaza::drawing
