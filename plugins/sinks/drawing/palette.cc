#include "plugins/sinks/drawing/palette.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace plaza::drawing {
namespace {

using Rgb = std::array<double, 3>;

/// Linear sRGB of an OKLCH colour; outside [0, 1] where a screen cannot show it.
Rgb linear_rgb(double lightness, double chroma, double hue_rad) {
  const double a = chroma * std::cos(hue_rad);
  const double b = chroma * std::sin(hue_rad);
  const double l = std::pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
  const double m = std::pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
  const double s = std::pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
  return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
          -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
          -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

bool can_be_shown(const Rgb& rgb) {
  return std::all_of(rgb.begin(), rgb.end(), [](double v) { return v >= 0 && v <= 1; });
}

double encode(double linear) {
  const double v = std::clamp(linear, 0.0, 1.0);
  return 255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055);
}

double decode(double encoded) {
  const double v = encoded / 255;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

}  // namespace

Color color_of(TrackId id) {
  constexpr double kGoldenAngle_rad = std::numbers::pi * (3 - 2.2360679774997896964);
  // Two people whose hues come close again (8 or 13 ids apart) differ in lightness.
  constexpr std::array kLightness = {0.73, 0.62, 0.83};
  const double hue_rad =
      std::fmod(static_cast<double>(id) * kGoldenAngle_rad, 2 * std::numbers::pi);
  const auto level = static_cast<std::size_t>(((id % 3) + 3) % 3);
  Rgb rgb{};
  for (double chroma = 0.19; chroma > 0; chroma -= 0.005) {
    rgb = linear_rgb(kLightness[level], chroma, hue_rad);
    if (can_be_shown(rgb)) break;
  }
  return {std::round(encode(rgb[2])), std::round(encode(rgb[1])), std::round(encode(rgb[0]))};
}

Color ink_on(const Color& background) {
  const double luminance = 0.0722 * decode(background[0]) + 0.7152 * decode(background[1]) +
                           0.2126 * decode(background[2]);
  const double to_white = 1.05 / (luminance + 0.05);
  const double to_black = (luminance + 0.05) / 0.05;
  return to_white > to_black ? Color(255, 255, 255) : Color(0, 0, 0);
}

Color mix(const Color& a, const Color& b, double share) { return a * share + b * (1 - share); }

const Theme& dark_theme() {
  static const Theme theme{.paper = {28, 24, 22},
                           .floor = {48, 42, 38},
                           .grid = {70, 63, 58},
                           .border = {150, 142, 136},
                           .text = {240, 238, 236},
                           .quiet_text = {172, 165, 158},
                           .camera = {205, 190, 150}};
  return theme;
}

const Theme& light_theme() {
  static const Theme theme{.paper = {255, 255, 255},
                           .floor = {250, 247, 245},
                           .grid = {228, 223, 219},
                           .border = {120, 112, 106},
                           .text = {38, 32, 28},
                           .quiet_text = {120, 112, 104},
                           .camera = {130, 100, 60}};
  return theme;
}

}  // namespace plaza::drawing
