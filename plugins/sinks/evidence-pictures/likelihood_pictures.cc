#include "plugins/sinks/evidence-pictures/likelihood_pictures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <sstream>

#include "plugins/sinks/drawing/canvas.h"
#include "plugins/sinks/drawing/ground_view.h"

namespace plaza::evidence_pictures {
namespace {

using drawing::Point;

constexpr double kLeast = 0.01;  // shares below it are no more than paper

Eigen::Vector2d corner_of(const GroundGrid& grid, double column, double row) {
  return grid.origin_m + grid.step_m.cwiseProduct(Eigen::Vector2d(column, row));
}

std::size_t index_of(const GroundGrid& grid, int column, int row) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns) +
         static_cast<std::size_t>(column);
}

/// Looks at the ground from an angle, without perspective: equal lengths along an axis stay equal.
class Slanted {
 public:
  Slanted(const GroundGrid& grid, cv::Size size) {
    const double w = std::max(1, grid.columns) * grid.step_m.x();
    const double h = std::max(1, grid.rows) * grid.step_m.y();
    centre_m_ = corner_of(grid, 0.5 * (grid.columns - 1), 0.5 * (grid.rows - 1));
    const double across = (w + h) * kCos;  // of the ground's rhombus
    const double deep = (w + h) * kSin;
    lift_ = 0.3 * across;
    scale_ = std::min(0.86 * size.width / across, 0.84 * size.height / (deep + lift_));
    origin_ = {0.5 * size.width, 0.5 * (size.height + scale_ * lift_)};
  }
  /// `height` in [0, 1].
  Point pixel(const Eigen::Vector2d& p_m, double height) const {
    const Eigen::Vector2d d = p_m - centre_m_;
    return origin_ +
           Point((d.x() - d.y()) * kCos, -(d.x() + d.y()) * kSin - height * lift_) * scale_;
  }

 private:
  static constexpr double kCos = 0.8, kSin = 0.38;
  Eigen::Vector2d centre_m_;
  double lift_ = 1, scale_ = 1;
  Point origin_;
};

std::string number(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

void draw_axes(cv::Mat& image, const Slanted& slanted, const GroundGrid& grid) {
  const drawing::Theme& theme = drawing::dark_theme();
  const Eigen::Vector2d low = corner_of(grid, -0.5, -0.5);
  const Eigen::Vector2d high = corner_of(grid, grid.columns - 0.5, grid.rows - 0.5);
  const double step_m = drawing::round_step((high - low).maxCoeff() / 8);
  const drawing::Stroke line{theme.grid, 1};
  const auto path = [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    const drawing::Path ends{slanted.pixel(a, 0), slanted.pixel(b, 0)};
    drawing::draw_path(image, ends, false, line);
  };
  // along the two sides that are nearest, where no surface hides the numbers
  for (const double x : drawing::multiples(low.x(), high.x(), step_m)) {
    path({x, low.y()}, {x, high.y()});
    drawing::draw_text(image, number(x), slanted.pixel({x, low.y()}, 0) + Point(10, 6),
                       {11, theme.quiet_text, drawing::Anchor::kTopLeft});
  }
  for (const double y : drawing::multiples(low.y(), high.y(), step_m)) {
    path({low.x(), y}, {high.x(), y});
    drawing::draw_text(image, number(y), slanted.pixel({low.x(), y}, 0) + Point(-10, 6),
                       {11, theme.quiet_text, drawing::Anchor::kTopRight});
  }
  const Eigen::Vector2d left(low.x(), high.y());
  const drawing::Path upright{slanted.pixel(left, 0), slanted.pixel(left, 1)};
  drawing::draw_path(image, upright, false, line);
  for (const double share : {0.0, 0.5, 1.0}) {
    drawing::draw_text(image, number(share), slanted.pixel(left, share) + Point(-10, -5),
                       {11, theme.quiet_text, drawing::Anchor::kTopRight});
  }
  const Eigen::Vector2d middle = 0.5 * (low + high);
  drawing::draw_text(image, "x [m]", slanted.pixel({middle.x(), low.y()}, 0) + Point(34, 30),
                     {12, theme.text, drawing::Anchor::kTopLeft});
  drawing::draw_text(image, "y [m]", slanted.pixel({low.x(), middle.y()}, 0) + Point(-34, 30),
                     {12, theme.text, drawing::Anchor::kTopRight});
}

}  // namespace

std::vector<double> relative_likelihood(std::span<const double> log_likelihood) {
  double most = -std::numeric_limits<double>::infinity();
  for (const double l : log_likelihood) {
    if (!std::isnan(l)) most = std::max(most, l);
  }
  std::vector<double> shares;
  shares.reserve(log_likelihood.size());
  for (const double l : log_likelihood) shares.push_back(std::exp(l - most));
  return shares;
}

drawing::Color likelihood_color(double share) {
  static const cv::Mat kTable = [] {
    cv::Mat1b grey(1, 256);
    for (int i = 0; i < 256; ++i) grey(0, i) = static_cast<unsigned char>(i);
    cv::Mat colors;
    cv::applyColorMap(grey, colors, cv::COLORMAP_VIRIDIS);
    return colors;
  }();
  const auto c =
      kTable.at<cv::Vec3b>(0, static_cast<int>(std::lround(255 * std::clamp(share, 0.0, 1.0))));
  return {static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2])};
}

cv::Mat likelihood_on_view(const cv::Mat& image, const Camera& camera, const GroundGrid& grid,
                           std::span<const double> shares) {
  cv::Mat out(camera.height(), camera.width(), CV_8UC3, cv::Scalar::all(30));
  if (!image.empty()) {
    cv::Mat grey;
    cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
    cv::cvtColor(grey, out, cv::COLOR_GRAY2BGR);
    out *= 0.55;  // so that the disks stand out
  }
  struct Cell {
    double share;
    Eigen::Vector2d centre_m;
  };
  std::vector<Cell> cells;
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const double share = shares[index_of(grid, column, row)];
      if (share >= kLeast) cells.push_back({share, corner_of(grid, column, row)});
    }
  }
  std::stable_sort(cells.begin(), cells.end(),
                   [](const Cell& a, const Cell& b) { return a.share < b.share; });
  cv::Mat layer = out.clone();
  for (const Cell& cell : cells) {
    // a circle on the ground, as the camera sees it; the likeliest one fills two cells
    const double radius_m = std::sqrt(cell.share) * grid.step_m.minCoeff();
    drawing::Path rim;
    for (int i = 0; i < 12; ++i) {
      const double a = 2 * CV_PI * i / 12;
      const Eigen::Vector2d p =
          cell.centre_m + radius_m * Eigen::Vector2d(std::cos(a), std::sin(a));
      if (const auto pixel = camera.project({p.x(), p.y(), 0})) {
        rim.emplace_back(pixel->x(), pixel->y());
      }
    }
    if (rim.size() == 12) drawing::fill_convex(layer, rim, likelihood_color(cell.share));
  }
  drawing::blend(out, layer, 0.9);
  return out;
}

cv::Mat likelihood_surface(const GroundGrid& grid, std::span<const double> shares, cv::Size size) {
  cv::Mat image(size, CV_8UC3, drawing::dark_theme().paper);
  const Slanted slanted(grid, size);
  draw_axes(image, slanted, grid);
  const auto share = [&](int column, int row) { return shares[index_of(grid, column, row)]; };
  // from the far corner (large x, large y) to the near one: what is nearer hides what is farther
  for (int depth = grid.columns + grid.rows - 4; depth >= 0; --depth) {
    for (int row = std::max(0, depth - grid.columns + 2); row <= std::min(depth, grid.rows - 2);
         ++row) {
      const int column = depth - row;
      drawing::Path patch;
      double most = 0;
      for (const auto& [c, r] :
           {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)}) {
        const double s = share(column + c, row + r);
        if (std::isnan(s)) break;
        most = std::max(most, s);
        patch.push_back(slanted.pixel(corner_of(grid, column + c, row + r), s));
      }
      if (patch.size() < 4) continue;
      const drawing::Color color = likelihood_color(most);
      drawing::fill_convex(image, patch, color);
      drawing::draw_path(image, patch, true, {drawing::mix(color, {0, 0, 0}, 0.8), 1});
    }
  }
  return image;
}

}  // namespace plaza::evidence_pictures
