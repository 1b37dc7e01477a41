#pragma once

#include <filesystem>
#include <functional>
#include <future>
#include <optional>
#include <string>

#include "engine/io/photo.h"

namespace patina {

/// Reads photos on a thread of its own, so that frames go on. The newest request wins; the destructor waits
/// for the one under way.
class PhotoLoader {
 public:
  static constexpr int kWholeSide = 1024;  ///< pixels of the longer side of the photo that is shown whole

  struct Request {
    std::filesystem::path file;
    std::optional<PhotoCrop> crop;
    bool operator==(const Request&) const = default;
  };
  struct Outcome {
    Request request;
    std::optional<Photo> photo;
    std::string error;  ///< one sentence, where there is no photo
  };

  /// @param wake  called from another thread when take() would find something
  explicit PhotoLoader(std::function<void()> wake) : wake_(std::move(wake)) {}

  void start(Request request);  ///< does nothing if it is being read already
  bool busy() const { return running_.valid(); }
  const Request& request() const { return request_; }  ///< the newest; while busy()

  std::optional<Outcome> take();  ///< how the newest request ended, once

 private:
  void run();

  std::function<void()> wake_;
  Request request_;
  bool outdated_ = false;  ///< what is being read is not what request_ asks for
  std::future<Outcome> running_;
};

}  // namespace patina
