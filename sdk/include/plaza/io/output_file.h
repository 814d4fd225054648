#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "plaza/core/error.h"
#include "plaza/core/export.h"

namespace plaza {

/// There is no room, or a quota is used up: no fault of what was to be written, and the same may
/// work later.
class PLAZA_API DiskFullError final : public UserError {
 public:
  using UserError::UserError;
  ~DiskFullError() override;
};

/// A file that bears its name only when it is complete. Until commit() its content grows in
/// "NAME.part" beside it, in whole records: whatever ends the process, NAME is absent, the earlier
/// file, or valid, and NAME.part ends with a whole record.
///
/// Every failure is a UserError that names file, cause and remedy; a full disk a DiskFullError.
/// What was written before a failure stays, cut to whole records; the rest is tried again by the
/// next flush() or commit(), unless drop_unwritten() gives it up.
class PLAZA_API OutputFile {
 public:
  /// Creates NAME.part, replacing one that an earlier process left. The folder must exist.
  explicit OutputFile(std::filesystem::path file);
  /// Removes NAME.part unless committed.
  ~OutputFile();
  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&&) = delete;

  /// Appends one record: a row, or any text that makes sense only as a whole. Buffered. A
  /// record is not taken when this throws.
  void write(std::string_view record);
  /// Hands all records to the operating system: they survive the death of this process.
  void flush();
  /// Gives up the records that the operating system has not taken.
  void drop_unwritten();
  /// Hands everything to the disk and gives the file its name. At most once.
  void commit();

  const std::filesystem::path& file() const { return file_; }
  const std::filesystem::path& part() const { return part_; }

 private:
  [[noreturn]] void fail(const char* action, int error);
  void close() noexcept;

  std::filesystem::path file_;
  std::filesystem::path part_;
  std::string buffer_;                    // whole records only
  std::vector<std::size_t> record_ends_;  // in the buffer, one past each record's last byte
  std::size_t written_ = 0;               // bytes in NAME.part, whole records only
  int descriptor_ = -1;
};

/// Writes a whole file at once, in the same way.
PLAZA_API void write_file(const std::filesystem::path& file, std::string_view content);

}  // namespace plaza
