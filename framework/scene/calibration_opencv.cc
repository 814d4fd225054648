#include <Eigen/Geometry>

#include "framework/scene/calibration.h"
#include "framework/scene/opencv_storage.h"
#include "plaza/core/error.h"

namespace plaza {
namespace {

using Names = std::vector<std::string>;

const Names kMatrixNames{
    "camera_matrix", "cameraMatrix", "Camera_Matrix", "intrinsic_matrix", "K", "M", "mtx"};
const Names kDistortionNames{"distortion_coefficients",
                             "Distortion_Coefficients",
                             "distCoeffs",
                             "dist_coeffs",
                             "distortion",
                             "dist",
                             "D"};
const Names kRotationNames{"R", "rotation_matrix", "rotation"};
const Names kRotationVectorNames{"rvec", "rotation_vector", "Rvec"};
const Names kTranslationNames{"T", "t", "tvec", "translation_vector", "translation", "Tvec"};

class StorageReader {
 public:
  StorageReader(const Storage& storage, std::string file, Diagnostics& faults)
      : storage_(storage), file_(std::move(file)), faults_(faults) {}

  const StorageValue* find(const Names& names) const {
    for (const std::string& name : names) {
      const auto found = storage_.find(name);
      if (found != storage_.end()) return &found->second;
    }
    return nullptr;
  }

  /// The numbers of the first name that is there, when their count is one of `counts`.
  const std::vector<double>* numbers(const Names& names,
                                     std::initializer_list<std::size_t> counts) {
    const StorageValue* value = find(names);
    if (value == nullptr) return nullptr;
    for (const std::size_t count : counts) {
      if (value->numeric && value->numbers.size() == count) return &value->numbers;
    }
    std::string list;
    for (const std::size_t& count : counts) {
      if (!list.empty()) list += &count + 1 == counts.end() ? " or " : ", ";
      list += std::to_string(count);
    }
    fault(value, value->name + " must hold " + list + " numbers" +
                     (value->numeric ? ", not " + std::to_string(value->numbers.size()) : ""));
    return nullptr;
  }

  void fault(const StorageValue* at, std::string message) {
    faults_.push_back(
        {at != nullptr ? at->where : FilePosition{file_, 1, 1}, "", std::move(message)});
  }

  void missing(const std::string& what, const Names& names) {
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
    fault(nullptr, "no " + what + "; looked for " + list);
  }

 private:
  const Storage& storage_;
  std::string file_;
  Diagnostics& faults_;
};

void read_intrinsics(StorageReader& reader, Calibration& out) {
  PinholeIntrinsics in;
  if (const auto* k = reader.numbers(kMatrixNames, {9})) {
    in = {(*k)[0], (*k)[4], (*k)[2], (*k)[5], {}};
    const StorageValue* at = reader.find(kMatrixNames);
    if (!(in.fx_px > 0 && in.fy_px > 0)) {
      reader.fault(at, "the focal lengths must be greater than 0");
    }
    if ((*k)[1] != 0 || (*k)[3] != 0 || (*k)[6] != 0 || (*k)[7] != 0 || (*k)[8] != 1) {
      reader.fault(at, "must be [fx 0 cx; 0 fy cy; 0 0 1], by rows");
    }
  } else if (reader.find(kMatrixNames) == nullptr) {
    reader.missing("camera matrix", kMatrixNames);
  }
  if (const auto* d = reader.numbers(kDistortionNames, {0, 4, 5, 8, 12, 14})) {
    const auto at = [d](std::size_t i) { return i < d->size() ? (*d)[i] : 0.0; };
    in.distortion = {at(0), at(1), at(2), at(3), at(4)};
    for (std::size_t i = 5; i < d->size(); ++i) {
      if ((*d)[i] == 0) continue;
      reader.fault(
          reader.find(kDistortionNames),
          "the rational, thin-prism and tilted models are not supported; calibrate with k1, "
          "k2, p1, p2, k3 only");
      break;
    }
  }
  out.intrinsics = in;
  const auto* width = reader.numbers({"image_width", "image_Width", "width"}, {1});
  const auto* height = reader.numbers({"image_height", "image_Height", "height"}, {1});
  const auto is_size = [](double v) { return v >= 1 && v <= 100'000 && v == static_cast<int>(v); };
  if (width != nullptr && height != nullptr) {
    const double w = width->front(), h = height->front();
    if (is_size(w) && is_size(h)) {
      out.image_size = Eigen::Vector2i(static_cast<int>(w), static_cast<int>(h));
    } else {
      reader.fault(reader.find({"image_width", "image_Width", "width"}),
                   "image width and height must be whole pixels from 1 to 100000");
    }
  }
}

void read_pose(StorageReader& reader, Calibration& out) {
  const bool by_vector = reader.find(kRotationNames) == nullptr;
  const Names& names = by_vector ? kRotationVectorNames : kRotationNames;
  if (const auto* r = reader.numbers(names, {3, 9})) {
    if (r->size() == 9) {
      out.pose.rotation = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(r->data());
    } else {
      const Eigen::Vector3d vector(r->data());
      const double angle = vector.norm();
      if (angle > 0)
        out.pose.rotation = Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix();
    }
  } else if (reader.find(names) == nullptr) {
    Names all = kRotationNames;
    all.insert(all.end(), kRotationVectorNames.begin(), kRotationVectorNames.end());
    reader.missing("rotation", all);
  }
  if (const auto* t = reader.numbers(kTranslationNames, {3})) {
    out.pose.translation = Eigen::Vector3d(t->data());
  } else if (reader.find(kTranslationNames) == nullptr) {
    reader.missing("translation", kTranslationNames);
  }
}

}  // namespace

Calibration parse_opencv(const TextFile& intrinsics, const TextFile* pose) {
  Diagnostics faults;
  Calibration out;
  out.where = {intrinsics.file, 1, 1};
  const Storage storage = parse_opencv_storage(intrinsics.text, intrinsics.file);
  StorageReader reader(storage, intrinsics.file, faults);
  read_intrinsics(reader, out);
  if (pose == nullptr) {
    read_pose(reader, out);
  } else {
    const Storage pose_storage = parse_opencv_storage(pose->text, pose->file);
    StorageReader pose_reader(pose_storage, pose->file, faults);
    read_pose(pose_reader, out);
  }
  if (!faults.empty()) throw UserError(std::move(faults));
  return out;
}

}  // namespace plaza
