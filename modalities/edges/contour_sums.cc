#include "modalities/edges/contour_sums.h"

#include <algorithm>
#include <vector>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace plaza::edges {
namespace {

/// Where runs begin.
struct InBlock {
  const std::uint8_t* block;
  const std::uint32_t* begins;
  const std::uint8_t* operator[](std::size_t run) const { return block + begins[run]; }
};
using Anywhere = const std::uint8_t* const*;

template <class Place>
void sum_plain(const Place& place, const ContourRuns& runs, ContourSum* sums) {
  std::size_t run = 0;
  for (std::size_t d = 0; d < runs.directions; ++d) {
    ContourSum sum;
    for (const std::size_t end = run + runs.counts[d]; run < end; ++run) {
      const std::uint8_t* bytes = place[run];
      for (int i = 0; i < runs.lengths[run]; ++i) {
        const auto steps = static_cast<std::uint64_t>(std::max(0, runs.peaks[d] - bytes[i]));
        if (bytes[i] == 0) {
          ++sum.outliers;
        } else {
          sum.squares += steps * steps;
        }
      }
    }
    sums[d] = sum;
  }
}

#if defined(__x86_64__)

/// [length]: 255 in the first `length` bytes.
struct RunMasks {
  constexpr RunMasks() {
    for (int length = 0; length <= kLongestRun; ++length) {
      for (int i = 0; i < 16; ++i) of[length][i] = i < length ? 255 : 0;
    }
  }
  alignas(16) std::uint8_t of[kLongestRun + 1][16] = {};
};
constexpr RunMasks kMasks;

// One vector of steps adds at most 4 * 254^2 to a 32-bit sum and 1 to an 8-bit one.
constexpr std::size_t kVectorsPerSum = 255;

template <class Place>
void sum_sse2(const Place& place, const ContourRuns& runs, ContourSum* sums) {
  const __m128i zero = _mm_setzero_si128(), one = _mm_set1_epi8(1);
  const auto load = [](const std::uint8_t* p) {
    return _mm_loadu_si128(reinterpret_cast<const __m128i*>(p));
  };
  std::size_t run = 0;
  for (std::size_t d = 0; d < runs.directions; ++d) {
    ContourSum sum;
    const __m128i peak = _mm_set1_epi8(static_cast<char>(runs.peaks[d]));
    for (const std::size_t last = run + runs.counts[d]; run < last;) {
      const std::size_t end = std::min(last, run + kVectorsPerSum);
      __m128i squares = zero, outliers = zero;
      for (; run < end; ++run) {
        const __m128i mask = load(kMasks.of[runs.lengths[run]]);
        const __m128i near = load(place[run]);
        const __m128i none = _mm_and_si128(_mm_cmpeq_epi8(near, zero), mask);
        outliers = _mm_add_epi8(outliers, _mm_and_si128(none, one));
        const __m128i steps = _mm_and_si128(_mm_subs_epu8(peak, near), _mm_xor_si128(none, mask));
        const __m128i low = _mm_unpacklo_epi8(steps, zero);
        const __m128i high = _mm_unpackhi_epi8(steps, zero);
        squares = _mm_add_epi32(squares, _mm_madd_epi16(low, low));
        squares = _mm_add_epi32(squares, _mm_madd_epi16(high, high));
      }
      squares = _mm_add_epi32(squares, _mm_shuffle_epi32(squares, 0x4E));
      squares = _mm_add_epi32(squares, _mm_shuffle_epi32(squares, 0xB1));
      sum.squares += static_cast<std::uint32_t>(_mm_cvtsi128_si32(squares));
      outliers = _mm_sad_epu8(outliers, zero);
      outliers = _mm_add_epi64(outliers, _mm_unpackhi_epi64(outliers, outliers));
      sum.outliers += static_cast<std::uint32_t>(_mm_cvtsi128_si32(outliers));
    }
    sums[d] = sum;
  }
}

/// Two runs at once. No lambdas and no functions of the standard library: they would not be
/// compiled for the same instructions.
template <class Place>
__attribute__((target("avx2"))) void sum_avx2(const Place& place, const ContourRuns& runs,
                                              ContourSum* sums) {
  const __m256i zero = _mm256_setzero_si256(), one = _mm256_set1_epi8(1);
  std::size_t run = 0;
  for (std::size_t d = 0; d < runs.directions; ++d) {
    ContourSum sum;
    const __m256i peak = _mm256_set1_epi8(static_cast<char>(runs.peaks[d]));
    for (const std::size_t last = run + runs.counts[d]; run < last;) {
      const std::size_t end = last - run < 2 * kVectorsPerSum ? last : run + 2 * kVectorsPerSum;
      __m256i squares = zero, outliers = zero;
      for (; run < end; run += 2) {
        const bool two = run + 1 < end;
        const std::uint8_t* first = place[run];
        const std::uint8_t* second = two ? place[run + 1] : first;
        const std::size_t length = two ? runs.lengths[run + 1] : 0;
        const __m256i mask = _mm256_inserti128_si256(
            _mm256_castsi128_si256(
                _mm_load_si128(reinterpret_cast<const __m128i*>(kMasks.of[runs.lengths[run]]))),
            _mm_load_si128(reinterpret_cast<const __m128i*>(kMasks.of[length])), 1);
        const __m256i near = _mm256_inserti128_si256(
            _mm256_castsi128_si256(_mm_loadu_si128(reinterpret_cast<const __m128i*>(first))),
            _mm_loadu_si128(reinterpret_cast<const __m128i*>(second)), 1);
        const __m256i none = _mm256_and_si256(_mm256_cmpeq_epi8(near, zero), mask);
        outliers = _mm256_add_epi8(outliers, _mm256_and_si256(none, one));
        const __m256i steps =
            _mm256_and_si256(_mm256_subs_epu8(peak, near), _mm256_xor_si256(none, mask));
        const __m256i low = _mm256_unpacklo_epi8(steps, zero);
        const __m256i high = _mm256_unpackhi_epi8(steps, zero);
        squares = _mm256_add_epi32(squares, _mm256_madd_epi16(low, low));
        squares = _mm256_add_epi32(squares, _mm256_madd_epi16(high, high));
      }
      run = end;
      __m128i half =
          _mm_add_epi32(_mm256_castsi256_si128(squares), _mm256_extracti128_si256(squares, 1));
      half = _mm_add_epi32(half, _mm_shuffle_epi32(half, 0x4E));
      half = _mm_add_epi32(half, _mm_shuffle_epi32(half, 0xB1));
      sum.squares += static_cast<std::uint32_t>(_mm_cvtsi128_si32(half));
      const __m256i counts = _mm256_sad_epu8(outliers, zero);
      half = _mm_add_epi64(_mm256_castsi256_si128(counts), _mm256_extracti128_si256(counts, 1));
      half = _mm_add_epi64(half, _mm_unpackhi_epi64(half, half));
      sum.outliers += static_cast<std::uint32_t>(_mm_cvtsi128_si32(half));
    }
    sums[d] = sum;
  }
}

#endif  // __x86_64__

template <void (*Sum)(const InBlock&, const ContourRuns&, ContourSum*)>
void in_block(const std::uint8_t* block, const ContourRuns& runs, ContourSum* sums) {
  Sum({block, runs.begins}, runs, sums);
}
template <void (*Sum)(const Anywhere&, const ContourRuns&, ContourSum*)>
void anywhere(const std::uint8_t* const* bytes, const ContourRuns& runs, ContourSum* sums) {
  Sum(bytes, runs, sums);
}

}  // namespace

std::span<const SumContourVersion> sum_contour_versions() {
  static const std::vector<SumContourVersion> kVersions = [] {
    std::vector<SumContourVersion> v = {
        {"plain", in_block<sum_plain<InBlock>>, anywhere<sum_plain<Anywhere>>}};
#if defined(__x86_64__)
    v.push_back(
        {"sse2", in_block<sum_sse2<InBlock>>, anywhere<sum_sse2<Anywhere>>});  // part of x86-64
    if (__builtin_cpu_supports("avx2")) {
      v.push_back({"avx2", in_block<sum_avx2<InBlock>>, anywhere<sum_avx2<Anywhere>>});
    }
#endif
    return v;
  }();
  return kVersions;
}

}  // namespace plaza::edges
