#include "framework/cache/codec_pieces.h"

#include <opencv2/imgcodecs.hpp>
#include <string_view>

namespace plaza::codec {

void put(ByteWriter& out, const Eigen::Vector2d& v) {
  out.real(v.x());
  out.real(v.y());
}

Eigen::Vector2d vector_of(ByteReader& in) {
  const double x = in.real();
  return {x, in.real()};
}

void put(ByteWriter& out, const Box& box) {
  out.real(box.left);
  out.real(box.top);
  out.real(box.width);
  out.real(box.height);
}

Box box_of(ByteReader& in) {
  Box box;
  box.left = in.real();
  box.top = in.real();
  box.width = in.real();
  box.height = in.real();
  return box;
}

/// PNG with little effort: as small as more effort makes it within a few percent where there is
/// noise, and several times as fast.
void put(ByteWriter& out, const std::vector<cv::Mat>& views) {
  out.word(views.size());
  for (const cv::Mat& view : views) {
    out.flag(!view.empty());
    if (view.empty()) continue;
    if (view.depth() != CV_8U || (view.channels() != 1 && view.channels() != 3)) throw Unkept{};
    std::vector<unsigned char> png;
    cv::imencode(".png", view, png, {cv::IMWRITE_PNG_COMPRESSION, 1});
    out.text({reinterpret_cast<const char*>(png.data()), png.size()});
  }
}

std::vector<cv::Mat> views_of(ByteReader& in) {
  std::vector<cv::Mat> views(in.count(1));
  for (cv::Mat& view : views) {
    if (!in.flag()) continue;
    const std::string_view png = in.text();
    const std::vector<unsigned char> bytes(png.begin(), png.end());
    view = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
    if (view.empty()) in.fail("holds a picture that is none");
  }
  return views;
}

void put(ByteWriter& out, const std::vector<ViewBox>& boxes) {
  out.word(boxes.size());
  for (const ViewBox& view : boxes) {
    out.word(view.camera);
    put(out, view.box);
    out.real(view.score);
  }
}

std::vector<ViewBox> boxes_of(ByteReader& in) {
  std::vector<ViewBox> boxes(in.count(48));
  for (ViewBox& view : boxes) {
    view.camera = in.word();
    view.box = box_of(in);
    view.score = in.real();
  }
  return boxes;
}

void put(ByteWriter& out, const TrackPoint& point) {
  out.integer(point.id);
  out.integer(point.frame);
  put(out, point.position_m);
  out.optional(point.heading_rad);
  out.real(point.score);
  out.flag(point.observed);
  out.flag(point.final);
  put(out, point.boxes);
}

TrackPoint point_of(ByteReader& in) {
  TrackPoint point;
  point.id = in.integer();
  point.frame = in.integer();
  point.position_m = vector_of(in);
  point.heading_rad = in.optional();
  point.score = in.real();
  point.observed = in.flag();
  point.final = in.flag();
  point.boxes = boxes_of(in);
  return point;
}

void put(ByteWriter& out, const std::vector<TrackPoint>& points) {
  out.word(points.size());
  for (const TrackPoint& point : points) put(out, point);
}

std::vector<TrackPoint> points_of(ByteReader& in) {
  std::vector<TrackPoint> points(in.count(43));
  for (TrackPoint& point : points) point = point_of(in);
  return points;
}

void put(ByteWriter& out, const GroundGrid& grid) {
  put(out, grid.origin_m);
  put(out, grid.step_m);
  out.integer(grid.columns);
  out.integer(grid.rows);
}

GroundGrid grid_of(ByteReader& in) {
  GroundGrid grid;
  grid.origin_m = vector_of(in);
  grid.step_m = vector_of(in);
  grid.columns = static_cast<int>(in.integer());
  grid.rows = static_cast<int>(in.integer());
  return grid;
}

void put(ByteWriter& out, const std::vector<double>& values) {
  out.word(values.size());
  for (const double value : values) out.real(value);
}

std::vector<double> values_of(ByteReader& in) {
  std::vector<double> values(in.count(8));
  for (double& value : values) value = in.real();
  return values;
}

}  // namespace plaza::codec
