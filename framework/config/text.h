#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace plaza {

/// The candidate nearest to `word` by edit distance (transpositions count once), or nothing when
/// none is near enough to be a likely misspelling. Ties go to the first.
std::optional<std::string> nearest(std::string_view word,
                                   const std::vector<std::string>& candidates);

/// `; did you mean "sigma_px"?` or empty.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

/// `"word"`.
std::string quote(std::string_view word);

/// `"a", "b", "c"`.
std::string quote_all(const std::vector<std::string>& words);

/// "a detector", "an affinity".
std::string a_or_an(std::string_view noun);

}  // namespace plaza
