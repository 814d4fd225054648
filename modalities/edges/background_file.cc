#include "modalities/edges/background_file.h"

#include <cstring>
#include <istream>
#include <iterator>
#include <ostream>
#include <string>
#include <string_view>

#include "plaza/core/error.h"

namespace plaza::edges {
namespace {

constexpr std::string_view kMagic = "plaza edges background 1\n";

std::uint64_t checksum(std::string_view bytes) {  // FNV-1a
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char c : bytes) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  }
  return hash;
}

template <class T>
void put(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

[[noreturn]] void refuse(const std::string& why) {
  throw UserError("the kept background of edges does not fit: " + why);
}

/// Reads values one after the other; never past the end.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}
  std::string_view take(std::size_t count) {
    if (count > bytes_.size()) refuse("it is cut short");
    const std::string_view taken = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return taken;
  }
  template <class T>
  T get() {
    T value;
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }
  bool empty() const { return bytes_.empty(); }

 private:
  std::string_view bytes_;
};

/// Edges and gradients; the zone follows from the edges.
void put_view(std::string& bytes, const ViewBackground& view) {
  bytes.append(reinterpret_cast<const char*>(view.edges.data), view.edges.total());
  bytes.append(reinterpret_cast<const char*>(view.gradient.data),
               view.gradient.total() * sizeof(cv::Vec2f));
}

ViewBackground get_view(Reader& reader, cv::Size size, double tolerance_px) {
  cv::Mat1b edges(size);
  std::memcpy(edges.data, reader.take(edges.total()).data(), edges.total());
  cv::Mat2f gradient(size);
  const std::size_t bytes = gradient.total() * gradient.elemSize();
  std::memcpy(gradient.data, reader.take(bytes).data(), bytes);
  return make_background(edges, gradient, tolerance_px);
}

}  // namespace

void save_backgrounds(std::ostream& out, const Scene& scene,
                      const std::vector<std::shared_ptr<const ViewBackground>>& views) {
  std::string bytes;
  put(bytes, static_cast<std::uint32_t>(views.size()));
  for (std::size_t c = 0; c < views.size(); ++c) {
    if (views[c] == nullptr) throw InternalError("a background is saved before it was learned");
    const Camera& camera = scene.cameras[c];
    put(bytes, static_cast<std::uint32_t>(camera.name().size()));
    bytes += camera.name();
    put(bytes, static_cast<std::int32_t>(camera.width()));
    put(bytes, static_cast<std::int32_t>(camera.height()));
    put(bytes, static_cast<std::uint8_t>(views[c]->known));
    if (views[c]->known) put_view(bytes, *views[c]);
  }
  put(bytes, checksum(bytes));
  out << kMagic << bytes;
}

std::vector<std::shared_ptr<const ViewBackground>> load_backgrounds(std::istream& in,
                                                                    const Scene& scene,
                                                                    double tolerance_px) {
  const std::string all{std::istreambuf_iterator<char>(in), {}};
  if (all.size() < kMagic.size() + sizeof(std::uint64_t) || !all.starts_with(kMagic)) {
    refuse("it is something else, or of another version");
  }
  const std::string_view body = std::string_view(all).substr(
      kMagic.size(), all.size() - kMagic.size() - sizeof(std::uint64_t));
  std::uint64_t wanted = 0;
  std::memcpy(&wanted, body.data() + body.size(), sizeof wanted);
  if (checksum(body) != wanted) refuse("it is damaged");
  Reader reader(body);
  if (reader.get<std::uint32_t>() != scene.cameras.size()) refuse("it has another number of views");
  std::vector<std::shared_ptr<const ViewBackground>> views;
  for (const Camera& camera : scene.cameras) {
    const std::string_view name = reader.take(reader.get<std::uint32_t>());
    const auto width = reader.get<std::int32_t>(), height = reader.get<std::int32_t>();
    if (name != camera.name() || width != camera.width() || height != camera.height()) {
      refuse("it is not of camera '" + camera.name() + "'");
    }
    const bool known = reader.get<std::uint8_t>() != 0;
    views.push_back(std::make_shared<const ViewBackground>(
        known ? get_view(reader, {width, height}, tolerance_px) : ViewBackground{}));
  }
  if (!reader.empty()) refuse("it goes on after its end");
  return views;
}

}  // namespace plaza::edges
