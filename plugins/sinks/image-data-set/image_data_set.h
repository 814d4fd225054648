#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "plaza/component/declaration.h"
#include "plaza/component/learner.h"
#include "plaza/io/output_file.h"

namespace plaza::data_set {

/// Writes what a source gives as an ordinary image data set: a numbered image per camera and frame,
/// people-free images, the truth as MOTChallenge rows per camera and on the ground, the scene with
/// its calibration, and a pipeline that reads it all back.
class ImageDataSet final : public Sink, public Learner {
 public:
  enum class Format { kPng, kJpeg };
  struct Options {
    std::string folder = "data-set";
    Format format = Format::kPng;
    int jpeg_quality = 95;
    std::int64_t people_free = 20;
  };
  static Declaration<Options> declare();
  ImageDataSet(const Options& options, const BuildContext& context);

  Learner* learner() override;

 private:
  void do_write(const NodeIo& io) override;
  void do_write_rest(const NodeIo& io) override;
  std::vector<Artifact> do_finish(bool complete) override;
  // learning: the people-free images, compressed, which are also what the cache keeps
  std::optional<LearningPlan> do_plan() const override;
  void do_learn(const FrameSet& frames) override;
  void do_finish(std::int64_t seen) override;
  void do_save(std::ostream& out) const override;
  void do_load(std::istream& in) override;

  std::string encoded(const cv::Mat& image) const;
  std::string extension() const { return options_.format == Format::kPng ? ".png" : ".jpg"; }
  std::filesystem::path image_file(const char* kind, std::size_t camera, std::int64_t number) const;
  void write_truth(const GroundTruth& truth, std::int64_t frame);
  void write_scene() const;
  void write_pipeline() const;
  void begin();

  Options options_;
  std::shared_ptr<const Scene> scene_;
  std::filesystem::path folder_;
  std::vector<std::vector<std::string>> people_free_;  // by image and camera; "": no view
  std::vector<char> has_images_;                       // by camera
  std::vector<OutputFile> rows_;                       // by camera
  std::unique_ptr<OutputFile> ground_;
  std::int64_t frames_ = 0;
  bool begun_ = false;
};

}  // namespace plaza::data_set
