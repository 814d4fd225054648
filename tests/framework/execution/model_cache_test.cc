#include "framework/execution/model_cache.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "plaza/core/error.h"
#include "tests/support/execution_doubles.h"

namespace plaza {
namespace {

using test::read_text;
using test::write_text;

class ModelCacheTest : public ::testing::Test {
 protected:
  test::TemporaryFolder folder_;
  ModelCache cache_{folder_ / "cache"};
  const std::string key_ = "everything that it depends on";
  const std::string content_ = std::string("model\0with any bytes\xff", 21);
};

TEST_F(ModelCacheTest, GivesBackWhatWasStored) {
  EXPECT_EQ(cache_.find(key_), std::nullopt);
  cache_.store(key_, content_);
  EXPECT_EQ(cache_.find(key_), content_);
  EXPECT_EQ(cache_.find(key_ + "!"), std::nullopt);
  cache_.store(key_, "newer");
  EXPECT_EQ(cache_.find(key_), "newer");
  cache_.store(key_, "");
  EXPECT_EQ(cache_.find(key_), "");
  cache_.remove(key_);
  EXPECT_EQ(cache_.find(key_), std::nullopt);
}

TEST_F(ModelCacheTest, LeavesNothingElseInItsFolder) {
  cache_.store(key_, content_);
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "cache")) {
    names.push_back(entry.path());
  }
  EXPECT_THAT(names, ::testing::ElementsAre(cache_.file_of(key_).string()));
}

TEST_F(ModelCacheTest, AnyFlippedBitMakesAnEntryWorthless) {
  cache_.store(key_, content_);
  const std::string entry = read_text(cache_.file_of(key_));
  for (std::size_t i = 0; i < entry.size(); ++i) {
    std::string damaged = entry;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
    write_text(cache_.file_of(key_), damaged);
    EXPECT_EQ(cache_.find(key_), std::nullopt) << "byte " << i;
  }
}

TEST_F(ModelCacheTest, AnyTruncationMakesAnEntryWorthless) {
  cache_.store(key_, content_);
  const std::string entry = read_text(cache_.file_of(key_));
  for (std::size_t size = 0; size < entry.size(); ++size) {
    write_text(cache_.file_of(key_), entry.substr(0, size));
    EXPECT_EQ(cache_.find(key_), std::nullopt) << size << " bytes";
  }
  write_text(cache_.file_of(key_), entry + "x");
  EXPECT_EQ(cache_.find(key_), std::nullopt);
}

TEST_F(ModelCacheTest, AnEntryOfAnotherKeyUnderTheSameNameIsNotTaken) {
  cache_.store("another key", content_);
  std::filesystem::rename(cache_.file_of("another key"), cache_.file_of(key_));
  EXPECT_EQ(cache_.find(key_), std::nullopt);
}

TEST_F(ModelCacheTest, AFolderThatCantBeMadeIsTheUsersError) {
  write_text(folder_ / "file", "");
  const ModelCache cache(folder_ / "file/cache");
  EXPECT_THROW(cache.store(key_, content_), UserError);
  EXPECT_EQ(cache.find(key_), std::nullopt);
}

TEST(HashTest, IsFnv1a) {
  Hash hash;
  EXPECT_EQ(hash.text(), "cbf29ce484222325");
  hash.add("foobar");
  EXPECT_EQ(hash.text(), "85944171f73967e8");  // the reference's test vector
}

}  // namespace
}  // namespace plaza
