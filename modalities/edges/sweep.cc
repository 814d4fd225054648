#include "modalities/edges/sweep.h"

#include <algorithm>
#include <vector>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace plaza::edges {
namespace {

void sweep_plain(const SweepTask& t) {
  const auto row = [&](int r) { return t.plane + r * t.stride; };
  for (int r = 0; r < t.rows; ++r) {
    const std::uint8_t* edges = t.edges + r * t.stride;
    const std::uint8_t* before = r > 0 ? row(r - 1) - t.drift[r] : nullptr;
    for (int c = 0; c < t.columns; ++c) {
      const int carried = before == nullptr ? 0 : std::max(0, before[c] - 1);
      row(r)[c] = static_cast<std::uint8_t>(std::max(edges[c] & t.peak, carried));
    }
    std::fill(row(r) + t.columns, row(r) + t.stride, std::uint8_t{0});
  }
  for (int r = t.rows - 2; r >= 0; --r) {
    const std::uint8_t* after = row(r + 1) + t.drift[r + 1];
    for (int c = 0; c < t.columns; ++c) {
      row(r)[c] = static_cast<std::uint8_t>(std::max<int>(row(r)[c], std::max(0, after[c] - 1)));
    }
  }
}

#if defined(__x86_64__)

/// 255 in the columns of the last vector of a row that belong to the image.
struct TailMask {
  explicit TailMask(const SweepTask& t) {
    const int begin = static_cast<int>(t.stride) - kSweepBytes;
    for (int i = 0; i < kSweepBytes; ++i) bytes[i] = begin + i < t.columns ? 255 : 0;
  }
  alignas(kSweepBytes) std::uint8_t bytes[kSweepBytes];
};

void sweep_sse2(const SweepTask& t) {
  const TailMask tail(t);
  const __m128i one = _mm_set1_epi8(1), peak = _mm_set1_epi8(static_cast<char>(t.peak));
  const __m128i all = _mm_set1_epi8(-1);
  const __m128i low = _mm_load_si128(reinterpret_cast<const __m128i*>(tail.bytes));
  const __m128i high = _mm_load_si128(reinterpret_cast<const __m128i*>(tail.bytes + 16));
  const std::ptrdiff_t last = t.stride - kSweepBytes;
  const auto mask = [&](std::ptrdiff_t c) { return c < last ? all : c == last ? low : high; };
  const auto at = [](std::uint8_t* p) { return reinterpret_cast<__m128i*>(p); };
  for (int r = 0; r < t.rows; ++r) {
    const std::uint8_t* edges = t.edges + r * t.stride;
    std::uint8_t* out = t.plane + r * t.stride;
    for (std::ptrdiff_t c = 0; c < t.stride; c += 16) {
      __m128i v = _mm_and_si128(_mm_loadu_si128(reinterpret_cast<const __m128i*>(edges + c)), peak);
      if (r > 0) {
        const __m128i before = _mm_loadu_si128(at(out - t.stride - t.drift[r] + c));
        v = _mm_max_epu8(v, _mm_and_si128(_mm_subs_epu8(before, one), mask(c)));
      }
      _mm_storeu_si128(at(out + c), v);
    }
  }
  for (int r = t.rows - 2; r >= 0; --r) {
    std::uint8_t* out = t.plane + r * t.stride;
    for (std::ptrdiff_t c = 0; c < t.stride; c += 16) {
      const __m128i after = _mm_loadu_si128(at(out + t.stride + t.drift[r + 1] + c));
      const __m128i carried = _mm_and_si128(_mm_subs_epu8(after, one), mask(c));
      _mm_storeu_si128(at(out + c), _mm_max_epu8(_mm_loadu_si128(at(out + c)), carried));
    }
  }
}

__attribute__((target("avx2"))) void sweep_avx2(const SweepTask& t) {
  const TailMask tail(t);
  const __m256i one = _mm256_set1_epi8(1), peak = _mm256_set1_epi8(static_cast<char>(t.peak));
  const __m256i tail_mask = _mm256_load_si256(reinterpret_cast<const __m256i*>(tail.bytes));
  const std::ptrdiff_t last = t.stride - kSweepBytes;
  for (int r = 0; r < t.rows; ++r) {
    const std::uint8_t* edges = t.edges + r * t.stride;
    std::uint8_t* out = t.plane + r * t.stride;
    if (r == 0) {
      for (std::ptrdiff_t c = 0; c < t.stride; c += kSweepBytes) {
        const __m256i e = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(edges + c));
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(out + c), _mm256_and_si256(e, peak));
      }
      continue;
    }
    const std::uint8_t* before = out - t.stride - t.drift[r];
    for (std::ptrdiff_t c = 0; c < last; c += kSweepBytes) {
      const __m256i e = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(edges + c));
      const __m256i b = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(before + c));
      _mm256_storeu_si256(reinterpret_cast<__m256i*>(out + c),
                          _mm256_max_epu8(_mm256_and_si256(e, peak), _mm256_subs_epu8(b, one)));
    }
    const __m256i e = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(edges + last));
    const __m256i b = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(before + last));
    const __m256i carried = _mm256_and_si256(_mm256_subs_epu8(b, one), tail_mask);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(out + last),
                        _mm256_max_epu8(_mm256_and_si256(e, peak), carried));
  }
  for (int r = t.rows - 2; r >= 0; --r) {
    std::uint8_t* out = t.plane + r * t.stride;
    const std::uint8_t* after = out + t.stride + t.drift[r + 1];
    for (std::ptrdiff_t c = 0; c < last; c += kSweepBytes) {
      const __m256i a = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(after + c));
      const __m256i v = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(out + c));
      _mm256_storeu_si256(reinterpret_cast<__m256i*>(out + c),
                          _mm256_max_epu8(v, _mm256_subs_epu8(a, one)));
    }
    const __m256i a = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(after + last));
    const __m256i v = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(out + last));
    const __m256i carried = _mm256_and_si256(_mm256_subs_epu8(a, one), tail_mask);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(out + last), _mm256_max_epu8(v, carried));
  }
}

#endif  // __x86_64__

}  // namespace

std::span<const SweepVersion> sweep_versions() {
  static const std::vector<SweepVersion> kVersions = [] {
    std::vector<SweepVersion> v = {{"plain", sweep_plain}};
#if defined(__x86_64__)
    v.push_back({"sse2", sweep_sse2});  // part of x86-64
    if (__builtin_cpu_supports("avx2")) v.push_back({"avx2", sweep_avx2});
#endif
    return v;
  }();
  return kVersions;
}

}  // namespace plaza::edges
