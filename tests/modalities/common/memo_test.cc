#include "modalities/common/memo.h"

#include <gtest/gtest.h>

#include <array>
#include <thread>

namespace plaza {
namespace {

TEST(Memo, KeepsWhatIsComputedFirst) {
  Memo<int> memo(3);
  EXPECT_FALSE(memo.knows(1));
  memo.keep(1, 7);
  memo.keep(1, 8);
  ASSERT_TRUE(memo.knows(1));
  EXPECT_EQ(memo.at(1), 7);
  EXPECT_FALSE(memo.knows(0));
}

TEST(Memo, IsWholeWhateverThreadsDo) {
  constexpr std::size_t kSize = 2000;
  Memos<std::array<std::size_t, 4>> memos;
  const BatchSerial batch;
  std::array<int, 4> wrong = {};
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < wrong.size(); ++t) {
    threads.emplace_back([&, t] {
      auto& memo = memos.of(batch, kSize);
      for (std::size_t i = 0; i < kSize; ++i) {
        if (memo.knows(i) && memo.at(i) != std::array{i, i + 1, i + 2, i + 3}) ++wrong[t];
        memo.keep(i, {i, i + 1, i + 2, i + 3});
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, (std::array<int, 4>{}));
  for (std::size_t i = 0; i < kSize; ++i) {
    ASSERT_TRUE(memos.of(batch, kSize).knows(i));
    ASSERT_EQ(memos.of(batch, kSize).at(i)[3], i + 3);
  }
}

TEST(Memos, TellBatchesApartThatLieInTheSamePlace) {
  Memos<int> memos;
  std::uint64_t first = 0;
  {
    const BatchSerial batch;
    first = batch.value();
    memos.of(batch, 2).keep(0, 5);
  }
  const BatchSerial other;
  EXPECT_NE(other.value(), first);
  EXPECT_FALSE(memos.of(other, 2).knows(0));
}

}  // namespace
}  // namespace plaza
