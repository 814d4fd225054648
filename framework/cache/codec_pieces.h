#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "framework/cache/bytes.h"
#include "plaza/data/observation.h"
#include "plaza/data/track.h"
#include "plaza/geometry/box.h"

/// What payloads are made of, as bytes and back, bit for bit. Readers throw DamagedEntry.
namespace plaza::codec {

/// Thrown where something can't be kept.
struct Unkept {};

void put(ByteWriter& out, const Eigen::Vector2d& v);
void put(ByteWriter& out, const Box& box);
void put(ByteWriter& out, const std::vector<ViewBox>& boxes);
void put(ByteWriter& out, const TrackPoint& point);
void put(ByteWriter& out, const std::vector<TrackPoint>& points);
void put(ByteWriter& out, const GroundGrid& grid);
void put(ByteWriter& out, const std::vector<double>& values);
/// Images of 8 bits with one or three channels, lossless; others are Unkept.
void put(ByteWriter& out, const std::vector<cv::Mat>& views);

Eigen::Vector2d vector_of(ByteReader& in);
Box box_of(ByteReader& in);
std::vector<ViewBox> boxes_of(ByteReader& in);
TrackPoint point_of(ByteReader& in);
std::vector<TrackPoint> points_of(ByteReader& in);
GroundGrid grid_of(ByteReader& in);
std::vector<double> values_of(ByteReader& in);
std::vector<cv::Mat> views_of(ByteReader& in);

}  // namespace plaza::codec
