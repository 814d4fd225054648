#include "framework/cache/node_entry.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "framework/cache/bytes.h"
#include "framework/cache/payload_codec.h"
#include "framework/execution/model_cache.h"
#include "plaza/core/error.h"

namespace plaza {
namespace {

using nlohmann::json;

constexpr std::string_view kMagic = "PLAZANOD";
constexpr std::uint64_t kLayout = 2;
constexpr std::size_t kWord = 8;

std::uint64_t hash_of(std::string_view bytes) {
  Hash hash;
  hash.add(bytes);
  return hash.value();
}

std::string header(std::string_view key) {
  ByteWriter out;
  out.word(kLayout);
  out.text(key);
  return std::string(kMagic) + out.take();
}

json to_json(const EntryInfo& info) {
  return {{"use", info.use},         {"node", info.node},
          {"port", info.port},       {"first_frame", info.first_frame},
          {"frames", info.frames},   {"declined", info.declined},
          {"seconds", info.seconds}, {"notes", info.notes}};
}

EntryInfo info_of(const json& value) {
  EntryInfo info;
  info.use = value.at("use").get<std::string>();
  info.node = value.at("node").get<std::string>();
  info.port = value.at("port").get<std::string>();
  info.first_frame = value.at("first_frame").get<std::int64_t>();
  info.frames = value.at("frames").get<std::int64_t>();
  info.declined = value.at("declined").get<bool>();
  info.seconds = value.at("seconds").get<std::map<std::string, double>>();
  info.notes = value.at("notes").get<std::vector<std::string>>();
  return info;
}

}  // namespace

EntryWriter::EntryWriter(std::filesystem::path file, std::string_view key)
    : file_(std::move(file)), part_(file_), key_(key) {
  part_ += ".part";
  descriptor_ = ::open(part_.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (descriptor_ < 0) {
    throw UserError("cannot write " + part_.string() + ": " + std::strerror(errno));
  }
  append(header(key_));
  start_ = written_;
}

EntryWriter::~EntryWriter() {
  if (descriptor_ < 0) return;
  ::close(descriptor_);
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
}

void EntryWriter::append(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw UserError("cannot write " + part_.string() + ": " + std::strerror(errno));
    bytes.remove_prefix(static_cast<std::size_t>(count));
    written_ += static_cast<std::uint64_t>(count);
  }
}

void EntryWriter::add(std::string_view bytes) {
  places_.push_back(written_);
  ByteWriter checksum;
  checksum.word(hash_of(bytes));
  append(checksum.take());
  append(bytes);
}

void EntryWriter::clear() {
  places_.clear();
  written_ = start_;
  if (::ftruncate(descriptor_, static_cast<off_t>(start_)) != 0 ||
      ::lseek(descriptor_, static_cast<off_t>(start_), SEEK_SET) < 0) {
    throw UserError("cannot write " + part_.string() + ": " + std::strerror(errno));
  }
}

void EntryWriter::commit(const EntryInfo& info) {
  const std::uint64_t index_place = written_;
  ByteWriter index;
  index.word(places_.size());
  for (const std::uint64_t place : places_) index.word(place);
  index.word(written_);
  index.text(to_json(info).dump(-1, ' ', true, json::error_handler_t::replace));
  std::string bytes = index.take();
  ByteWriter end;
  end.word(hash_of(bytes));
  end.word(index_place);
  append(bytes);
  append(end.take());
  const bool good = ::fsync(descriptor_) == 0;
  const int error = errno;
  ::close(std::exchange(descriptor_, -1));
  std::error_code failed;
  if (good) std::filesystem::rename(part_, file_, failed);
  if (good && !failed) return;
  const std::string reason = good ? failed.message() : std::strerror(error);
  std::filesystem::remove(part_, failed);
  throw UserError("cannot write " + file_.string() + ": " + reason);
}

EntryReader::~EntryReader() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::unique_ptr<EntryReader> EntryReader::open(const std::filesystem::path& file,
                                               std::string_view key, FeatureLoaders loaders) {
  std::unique_ptr<EntryReader> reader(new EntryReader);
  reader->file_ = file;
  reader->loaders_ = std::move(loaders);
  try {
    if (!reader->read_index(key, false)) return nullptr;
  } catch (const DamagedEntry&) {
    return nullptr;
  }
  ::utimensat(AT_FDCWD, file.c_str(), nullptr, 0);  // used now: others are removed before it
  return reader;
}

std::optional<EntryInfo> EntryReader::look(const std::filesystem::path& file) {
  EntryReader reader;
  reader.file_ = file;
  try {
    if (!reader.read_index({}, true)) return std::nullopt;
  } catch (const DamagedEntry&) {
    return std::nullopt;
  }
  return reader.info_;
}

std::string EntryReader::read(std::uint64_t offset, std::uint64_t size) const {
  if (offset > size_ || size > size_ - offset) {
    throw DamagedEntry(file_.string(), "the entry is too short");
  }
  std::string bytes(static_cast<std::size_t>(size), '\0');
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count = ::pread(descriptor_, bytes.data() + done, bytes.size() - done,
                                  static_cast<off_t>(offset + done));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) throw DamagedEntry(file_.string(), "the entry can't be read");
    done += static_cast<std::size_t>(count);
  }
  return bytes;
}

bool EntryReader::read_index(std::string_view key, bool any_key) {
  descriptor_ = ::open(file_.c_str(), O_RDONLY | O_CLOEXEC);
  struct stat status {};
  if (descriptor_ < 0 || ::fstat(descriptor_, &status) != 0) return false;
  size_ = static_cast<std::uint64_t>(status.st_size);
  if (size_ < kMagic.size() + 4 * kWord) return false;

  if (!any_key) {
    const std::string wanted = header(key);
    if (wanted.size() > size_ || read(0, wanted.size()) != wanted) return false;
  } else if (read(0, kMagic.size()) != kMagic) {
    return false;
  }
  const std::string end = read(size_ - 2 * kWord, 2 * kWord);
  ByteReader tail(end, file_.string());
  const std::uint64_t checksum = tail.word();
  const std::uint64_t place = tail.word();
  if (place > size_ - 2 * kWord) return false;
  const std::string bytes = read(place, size_ - 2 * kWord - place);
  if (hash_of(bytes) != checksum) return false;
  ByteReader index(bytes, file_.string());
  places_.resize(index.count(kWord));
  for (std::uint64_t& record : places_) record = index.word();
  places_.push_back(index.word());
  try {
    info_ = info_of(json::parse(index.text()));
  } catch (const json::exception&) {
    return false;
  }
  index.expect_end();
  const auto records = static_cast<std::uint64_t>(info_.declined ? 0 : info_.frames + 1);
  return places_.size() == records + 1;
}

PayloadPtr EntryReader::record(std::size_t index) const {
  const std::uint64_t begin = places_.at(index);
  const std::uint64_t end = places_.at(index + 1);
  if (end < begin + kWord) throw DamagedEntry(file_.string(), "the entry has a wrong index");
  const std::string bytes = read(begin, end - begin);
  const std::string_view content = std::string_view(bytes).substr(kWord);
  if (ByteReader(bytes, file_.string()).word() != hash_of(content)) {
    throw DamagedEntry(file_.string(), "the entry is damaged");
  }
  if (content.empty()) return nullptr;
  return decode_payload(info_.port, content, loaders_, file_.string());
}

PayloadPtr EntryReader::payload(std::int64_t frame) const {
  if (frame < info_.first_frame || frame >= info_.first_frame + info_.frames) {
    throw InternalError(file_.string() + ": frame " + std::to_string(frame + 1) + " isn't kept");
  }
  return record(static_cast<std::size_t>(frame - info_.first_frame));
}

PayloadPtr EntryReader::flushed() const { return record(static_cast<std::size_t>(info_.frames)); }

}  // namespace plaza
