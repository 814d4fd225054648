#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "plaza/plugin_abi.h"

namespace plaza {

/// Why code with tag `found` can't share objects with code with tag `wanted`: every field that
/// differs, in words, with what to rebuild. Empty when the two fit.
std::string abi_mismatch(const AbiTag& found, const AbiTag& wanted);

/// Why a library's descriptor can't be used by this program; empty when it can. Reads only as much
/// as the magic, the layout number and the size allow.
std::string descriptor_mismatch(const PluginDescriptor& found);

/// Descriptors in the bytes of a library file, which can be read without running any of its code:
/// static initialisers run as soon as a library is opened, and symbols that another SDK version
/// lacks keep it from opening at all. Function pointers are not relocated and must not be used.
std::vector<PluginDescriptor> descriptors_in_file(const std::filesystem::path& library);

/// "0.1.0" from 100.
std::string version_text(std::uint32_t number);

}  // namespace plaza
