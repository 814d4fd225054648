#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "plaza/contract/contract.h"

namespace plaza::contract {

/// How every component of this tree is tried, by its name: add yours here, with values for what is
/// required and for each way of working that is worth a trial. `files` is a folder for input files
/// that a trial needs; it exists as long as the trial.
std::vector<Trial> trials_of(const std::string& component, const std::filesystem::path& files);

}  // namespace plaza::contract
