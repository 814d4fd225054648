#include "framework/config/text.h"

#include <algorithm>
#include <cctype>

namespace plaza {
namespace {

/// Case and the kind of separator are the likeliest slips; they cost nothing.
std::string normalized(std::string_view word) {
  std::string out(word);
  for (char& c : out) {
    c = c == '-' || c == ' ' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return out;
}

/// Optimal string alignment: insertions, deletions, replacements and swaps of neighbours cost one
/// each.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  const std::size_t width = b.size() + 1;
  std::vector<std::size_t> before_last(width);
  std::vector<std::size_t> last(width);
  std::vector<std::size_t> row(width);
  for (std::size_t j = 0; j < width; ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(before_last, last);
    std::swap(last, row);
    row[0] = i;
    for (std::size_t j = 1; j < width; ++j) {
      row[j] =
          std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0U : 1U)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        row[j] = std::min(row[j], before_last[j - 2] + 1);
      }
    }
  }
  return row.back();
}

constexpr std::size_t kLongestWord = 200;  // beyond it nobody misspelt a name

}  // namespace

std::optional<std::string> nearest(std::string_view word,
                                   const std::vector<std::string>& candidates) {
  if (word.empty() || word.size() > kLongestWord) return std::nullopt;
  const std::string wanted = normalized(word);
  const std::string* best = nullptr;
  std::size_t best_distance = 0;
  for (const std::string& candidate : candidates) {
    if (candidate.empty() || candidate.size() > kLongestWord) continue;
    const std::string other = normalized(candidate);
    // every third letter may be wrong, but a word is never made of slips alone
    const std::size_t longest = std::max(wanted.size(), other.size());
    const std::size_t limit = longest < 3 ? 1 : std::max<std::size_t>(1, longest / 3);
    std::size_t distance = edit_distance(wanted, other);
    if (distance >= longest) continue;
    // "sigma" for "sigma_px", "rate" for "frame_rate": a whole part of the name
    const bool is_part =
        wanted.size() >= 3 && (other.starts_with(wanted + "_") || other.ends_with("_" + wanted));
    if (is_part) distance = std::min(distance, limit);
    if (distance > limit) continue;
    if (best == nullptr || distance < best_distance) {
      best = &candidate;
      best_distance = distance;
    }
  }
  if (best == nullptr) return std::nullopt;
  return *best;
}

std::string quote(std::string_view word) {
  std::string out;
  out.reserve(word.size() + 2);
  out += '"';
  out += word;
  out += '"';
  return out;
}

std::string quote_all(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& word : words) {
    if (!out.empty()) out += ", ";
    out += quote(word);
  }
  return out;
}

std::string a_or_an(std::string_view noun) {
  constexpr std::string_view kVowels = "aeiouAEIOU";
  const bool vowel = !noun.empty() && kVowels.find(noun.front()) != std::string_view::npos;
  std::string out = vowel ? "an " : "a ";
  out += noun;
  return out;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates) {
  const std::optional<std::string> found = nearest(word, candidates);
  if (!found) return {};
  return "; did you mean " + quote(*found) + "?";
}

}  // namespace plaza
