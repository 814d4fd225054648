#include "framework/plugin/registry.h"

#include <algorithm>
#include <utility>

#include "framework/config/text.h"
#include "plaza/core/error.h"

namespace plaza {
namespace {

bool is_valid_name(std::string_view name) {
  const auto is_letter = [](char c) { return c >= 'a' && c <= 'z'; };
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  if (name.empty() || !is_letter(name.front()) || name.back() == '-') return false;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (!is_letter(name[i]) && !is_digit(name[i]) && name[i] != '-') return false;
    if (name[i] == '-' && name[i - 1] == '-') return false;
  }
  return true;
}

std::string described(const std::filesystem::path& library) {
  return library.empty() ? "the program itself" : library.string();
}

std::string in_quotes(std::string_view word) { return '"' + std::string(word) + '"'; }

/// "a detector", "an affinity".
std::string with_article(std::string_view kind) {
  const bool vowel =
      !kind.empty() && std::string_view("aeiou").find(kind[0]) != std::string_view::npos;
  return (vowel ? "an " : "a ") + std::string(kind);
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

}  // namespace

std::shared_ptr<Component> ComponentEntry::create(const nlohmann::json& values,
                                                  const BuildContext& context) const {
  std::unique_ptr<Component> component = factory(values, context);
  if (!component)
    throw InternalError("the factory of " + in_quotes(declaration.name) + " made nothing");
  // the deleter outlives the object: code of the library runs until the destructor has returned
  return {component.release(), [library = library_handle](Component* c) { delete c; }};
}

void Registry::check_addable(const ComponentEntry& entry) const {
  const ComponentDeclaration& declaration = entry.declaration;
  if (!is_valid_name(declaration.name)) {
    throw UserError(described(entry.library) + " provides a component with the invalid name " +
                    in_quotes(declaration.name) +
                    "; names are lower-case letters, digits and single hyphens between them");
  }
  const std::vector<std::string>& kinds = component_kinds();
  if (std::find(kinds.begin(), kinds.end(), declaration.kind) == kinds.end()) {
    throw UserError(described(entry.library) + " provides " + in_quotes(declaration.name) +
                    " of the unknown kind " + in_quotes(declaration.kind) + "; kinds are " +
                    joined(kinds));
  }
  const auto existing = entries_.find(declaration.name);
  if (existing != entries_.end()) {
    throw UserError("component " + in_quotes(declaration.name) + " is provided twice: by " +
                    described(existing->second.library) + " and by " + described(entry.library) +
                    "; remove one of the libraries or rename one of the components");
  }
}

void Registry::add(ComponentEntry entry) {
  check_addable(entry);
  std::string name = entry.declaration.name;
  entries_.emplace(std::move(name), std::move(entry));
}

void Registry::add_all(std::vector<ComponentEntry> entries) {
  Registry together;  // so that a name that one library uses twice is found, too
  for (ComponentEntry& entry : entries) {
    check_addable(entry);
    together.add(std::move(entry));
  }
  entries_.merge(together.entries_);
}

void Registry::add_refused(RefusedPlugin refused) {
  const bool known = std::any_of(refused_.begin(), refused_.end(), [&](const RefusedPlugin& other) {
    return other.library == refused.library;
  });
  if (!known) refused_.push_back(std::move(refused));
}

void Registry::add_searched(std::filesystem::path directory) {
  if (std::find(searched_.begin(), searched_.end(), directory) == searched_.end()) {
    searched_.push_back(std::move(directory));
  }
}

bool Registry::has_library(const std::filesystem::path& canonical) const {
  return std::any_of(entries_.begin(), entries_.end(),
                     [&](const auto& entry) { return entry.second.library == canonical; });
}

std::optional<std::filesystem::path> Registry::library_named(
    const std::filesystem::path& file_name) const {
  for (const auto& [name, entry] : entries_) {
    if (!entry.library.empty() && entry.library.filename() == file_name) return entry.library;
  }
  return std::nullopt;
}

const ComponentEntry* Registry::find(std::string_view name) const {
  const auto it = entries_.find(name);
  return it == entries_.end() ? nullptr : &it->second;
}

std::vector<const ComponentEntry*> Registry::all(std::string_view kind) const {
  std::vector<const ComponentEntry*> out;
  for (const auto& [name, entry] : entries_) {
    if (kind.empty() || entry.declaration.kind == kind) out.push_back(&entry);
  }
  return out;
}

std::string Registry::explain_missing(std::string_view name, std::string_view kind) const {
  const std::string what = kind.empty() ? "component" : std::string(kind);
  std::vector<std::string> names;
  for (const ComponentEntry* entry : all(kind)) names.push_back(entry->declaration.name);
  const auto choice = [&] {
    return names.empty() ? "no library that was loaded provides " + with_article(what)
                         : "known are " + joined(names);
  };
  if (const ComponentEntry* other = find(name)) {
    return in_quotes(name) + " is " + with_article(other->declaration.kind) + ", not " +
           with_article(what) + "; " + choice();
  }
  for (const RefusedPlugin& refused : refused_) {
    if (std::find(refused.provides.begin(), refused.provides.end(), name) !=
        refused.provides.end()) {
      return in_quotes(name) + " would come from " + refused.library.string() +
             ", which was refused: " + refused.reason;
    }
  }
  std::string text = "unknown " + what + " " + in_quotes(name);
  if (const std::optional<std::string> close = nearest(name, names)) {
    return text + "; did you mean " + in_quotes(*close) + "?";
  }
  // a name of another kind, misspelled, is still worth a hint
  std::vector<std::string> others;
  for (const ComponentEntry* entry : all()) others.push_back(entry->declaration.name);
  if (const std::optional<std::string> close = nearest(name, others)) {
    return text + "; " + in_quotes(*close) + " is " + with_article(find(*close)->declaration.kind) +
           "; " + choice();
  }
  text += "; " + choice();
  if (!refused_.empty()) {
    std::vector<std::string> libraries;
    for (const RefusedPlugin& refused : refused_) libraries.push_back(refused.library.string());
    text += "; refused libraries (see `plaza plugins`): " + joined(libraries);
  }
  if (names.empty()) {
    std::vector<std::string> folders;
    for (const std::filesystem::path& folder : searched_) folders.push_back(folder.string());
    text += folders.empty() ? "; no folder was searched for plugins; give one with --plugin-path"
                            : "; searched " + joined(folders);
  }
  return text;
}

}  // namespace plaza
