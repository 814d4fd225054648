// Entries on disk: damaged ones are never trusted, the least recently used go first.
#include "framework/cache/node_cache.h"

#include <gtest/gtest.h>

#include "framework/cache/bytes.h"
#include "framework/cache/payload_codec.h"
#include "plaza/core/error.h"
#include "plaza/data/detections.h"
#include "tests/support/execution_doubles.h"

namespace plaza {
namespace {

namespace fs = std::filesystem;

class NodeCacheTest : public ::testing::Test {
 protected:
  static std::string bytes_of(double score) {
    Detections detections;
    detections.views = {{{.box = {1, 2, 3, 4}, .score = score}}};
    return *encode_payload(detections, {});
  }
  static EntryInfo info(std::int64_t frames) {
    EntryInfo info;
    info.use = "finder";
    info.node = "detector";
    info.port = Detections::kPort;
    info.first_frame = 100;
    info.frames = frames;
    info.seconds = {{"detector", 1.5}};
    info.notes = {"a note"};
    return info;
  }
  /// Three frames, of which the second gave nothing, and something when flushed.
  void store(const std::string& key) const {
    const auto writer = cache_.create(key);
    writer->add(bytes_of(1));
    writer->add("");
    writer->add(bytes_of(3));
    writer->add(bytes_of(4));
    writer->commit(info(3));
  }
  static double score(const PayloadPtr& payload) {
    return dynamic_cast<const Detections&>(*payload).views[0][0].score;
  }
  fs::path only_file() const {
    for (const auto& entry : fs::directory_iterator(folder_ / "nodes")) return entry.path();
    return {};
  }

  test::TemporaryFolder folder_;
  NodeCache cache_{folder_.path(), 1000000};
};

TEST_F(NodeCacheTest, GivesBackWhatWasStored) {
  EXPECT_EQ(cache_.open("key"), nullptr);
  store("key");
  const auto reader = cache_.open("key");
  ASSERT_NE(reader, nullptr);
  EXPECT_EQ(score(reader->payload(102)), 3);
  EXPECT_EQ(score(reader->payload(100)), 1) << "in any order";
  EXPECT_EQ(reader->payload(101), nullptr);
  EXPECT_EQ(score(reader->flushed()), 4);
  EXPECT_THROW(reader->payload(103), InternalError);
  EXPECT_THROW(reader->payload(99), InternalError);
  EXPECT_EQ(reader->info().seconds.at("detector"), 1.5);
  EXPECT_EQ(reader->info().notes.at(0), "a note");
  EXPECT_EQ(cache_.open("another key"), nullptr);
}

TEST_F(NodeCacheTest, AnEntryOfAnotherKeyWithTheSameHashIsNotTaken) {
  store("key");
  const auto writer = cache_.create("other");
  writer->commit([] {
    EntryInfo i = info(0);
    i.declined = true;
    return i;
  }());
  fs::path mine, others;
  for (const auto& entry : fs::directory_iterator(folder_ / "nodes")) {
    (EntryReader::look(entry.path())->declined ? others : mine) = entry.path();
  }
  fs::rename(mine, others);
  EXPECT_EQ(cache_.open("other"), nullptr);
}

TEST_F(NodeCacheTest, AnyChangedByteIsNoticed) {
  store("key");
  const fs::path file = only_file();
  const std::string whole = test::read_text(file);
  int refused = 0, found = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
    test::write_text(file, damaged);
    const auto reader = cache_.open("key");
    if (reader == nullptr) {
      ++refused;
      continue;
    }
    const auto read_all = [&] {
      for (int f = 100; f < 103; ++f) reader->payload(f);
      reader->flushed();
    };
    EXPECT_THROW(read_all(), DamagedEntry) << "byte " << i;
    ++found;
  }
  EXPECT_GT(refused, 100) << "header and index";
  EXPECT_GT(found, 100) << "payloads";
}

TEST_F(NodeCacheTest, CutEntriesAreNotUsed) {
  store("key");
  const fs::path file = only_file();
  const std::string whole = test::read_text(file);
  for (std::size_t size = 0; size < whole.size(); size += 7) {
    test::write_text(file, whole.substr(0, size));
    EXPECT_EQ(cache_.open("key"), nullptr) << size << " of " << whole.size() << " bytes";
  }
}

TEST_F(NodeCacheTest, AnEntryIsThereWholeOrNotAtAll) {
  {
    const auto writer = cache_.create("key");
    writer->add(bytes_of(1));
    EXPECT_EQ(cache_.open("key"), nullptr);
  }
  EXPECT_EQ(cache_.open("key"), nullptr);
  EXPECT_TRUE(fs::is_empty(folder_ / "nodes")) << "what was not committed leaves nothing behind";
}

TEST_F(NodeCacheTest, OneAtATimeMayComputeAnEntry) {
  auto first = cache_.try_lock("key");
  EXPECT_TRUE(first);
  EXPECT_FALSE(cache_.try_lock("key"));
  EXPECT_TRUE(cache_.try_lock("another"));
  first.reset();
  EXPECT_TRUE(cache_.try_lock("key"));
}

TEST_F(NodeCacheTest, TheLeastRecentlyUsedGoesFirstAndOrphansGoAlways) {
  for (const char* key : {"a", "b", "c", "d"}) {
    store(key);
    for (const CachedFile& file : cache_.list()) {  // all older by a second
      fs::last_write_time(file.file, file.used - std::chrono::seconds(1));
    }
  }
  const std::uintmax_t size = cache_.list()[0].bytes;
  ASSERT_NE(cache_.open("a"), nullptr) << "which uses it";
  folder_.write("nodes/0123456789abcdef.node.part", "of a process that was killed");
  const NodeCache small(folder_.path(), 2 * size + 10);
  EXPECT_GE(small.make_room(), 2 * size - 10);
  EXPECT_NE(cache_.open("a"), nullptr);
  EXPECT_NE(cache_.open("d"), nullptr);
  EXPECT_EQ(cache_.open("b"), nullptr);
  EXPECT_EQ(cache_.open("c"), nullptr);
  EXPECT_FALSE(fs::exists(folder_ / "nodes/0123456789abcdef.node.part"));
}

TEST_F(NodeCacheTest, WhatIsOpenStaysReadableWhenItIsRemoved) {
  store("key");
  const auto reader = cache_.open("key");
  EXPECT_EQ(cache_.clear(""), 1U);
  EXPECT_EQ(score(reader->payload(102)), 3);
  EXPECT_EQ(cache_.open("key"), nullptr);
}

TEST_F(NodeCacheTest, ClearsByComponentAndListsWhatThereIs) {
  store("key");
  folder_.write("0123.learned", "a model");
  folder_.write("nodes/4567.node", "nonsense");
  EXPECT_EQ(cache_.list().size(), 3U);
  EXPECT_EQ(cache_.clear("another"), 0U);
  EXPECT_EQ(cache_.clear("finder"), 1U);
  EXPECT_EQ(cache_.clear(""), 2U);
  EXPECT_TRUE(cache_.list().empty());
}

TEST(SizeTextTest, HasAUnitThatFits) {
  EXPECT_EQ(size_text(0), "0 B");
  EXPECT_EQ(size_text(999), "999 B");
  EXPECT_EQ(size_text(1500), "1.5 kB");
  EXPECT_EQ(size_text(20000000000U), "20.0 GB");
}

}  // namespace
}  // namespace plaza
