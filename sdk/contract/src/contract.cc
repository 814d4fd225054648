#include "plaza/contract/contract.h"

#include <unistd.h>

#include <cstdlib>
#include <map>
#include <string_view>
#include <system_error>

#include "stage.h"

namespace plaza::contract {
namespace {

namespace fs = std::filesystem;

class OutputFolder {
 public:
  explicit OutputFolder(const fs::path& given) : path_(given), temporary_(given.empty()) {
    if (!temporary_) {
      fs::remove_all(path_);
      fs::create_directories(path_);
      return;
    }
    std::string pattern = (fs::temp_directory_path() / "plaza-contract-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw UserError("can't make a folder " + pattern);
    path_ = pattern;
  }
  ~OutputFolder() {
    std::error_code ignored;
    if (temporary_) fs::remove_all(path_, ignored);
  }
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
  bool temporary_;
};

const std::map<std::string_view, void (*)(const Stage&, Findings&)>& checks() {
  static const std::map<std::string_view, void (*)(const Stage&, Findings&)> kChecks = {
      {"source", check_source},
      {"modality", check_modality},
      {"shape", check_shape},
      {"appearance", check_appearance},
      {"motion", check_motion},
      {"detector", check_detector},
      {"describer", check_describer},
      {"affinity", check_affinity},
      {"associator", check_associator},
      {"evaluator", check_evaluator},
      {"sink", check_sink},
      {"renderer", check_renderer},
  };
  return kChecks;
}

}  // namespace

std::vector<std::string> violations(const Subject& subject, const Trial& trial) {
  Findings findings;
  for (std::string& text : declaration_violations(subject.declaration))
    findings.add(std::move(text));
  const auto check = checks().find(subject.declaration.kind);
  if (check == checks().end()) return findings.take();

  const OutputFolder folder(trial.output_folder);
  const Stage stage(subject, trial, folder.path());
  const bool made = findings.step("making the component", [&] {
    for (const Diagnostic& d : stage.make_untaught()->check()) {
      findings.add("check() finds fault with a trial that should work: " + to_string(d));
    }
    stage.make();
  });
  if (!made) return findings.take();
  findings.step("the check of the kind", [&] { check->second(stage, findings); });
  findings.step("the check of learning", [&] { check_learner(stage, findings); });
  return findings.take();
}

}  // namespace plaza::contract
