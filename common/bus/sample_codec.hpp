#pragma once

// Samples as bytes and back, without knowing their C++ types or the middleware.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/bus/qos.hpp"

namespace aisle::bus {

/// A sample without its C++ type; it knows how to delete itself.
using AnySample = std::unique_ptr<void, std::function<void(void*)>>;

/// CDR of one topic's type, the very bytes that DDS writes (XCDR version 1, little endian, encapsulation in front).
/// `sample` is always of the topic's type. Not for use by several threads at once.
class SampleCodec {
 public:
  virtual ~SampleCodec() = default;

  /// Its name in topics.hpp.
  virtual const std::string& topic() const = 0;

  /// As announced on the wire, "aisle::Plan".
  virtual const std::string& type_name() const = 0;
  virtual const Qos& qos() const = 0;

  /// With default values.
  virtual AnySample new_sample() const = 0;

  /// Replaces `bytes`. False when the sample cannot be written (a string or sequence beyond its bound).
  virtual bool encode(const void* sample, std::vector<std::uint8_t>& bytes) const = 0;

  /// False when the bytes are no such sample; it then has default values.
  virtual bool decode(const std::vector<std::uint8_t>& bytes, void* sample) const = 0;

  /// Replaces `key` by bytes that are equal for samples with equal key fields, and only for these.
  virtual void key(const void* sample, std::string& key) const = 0;

  /// Copies the key fields and leaves the others of `to` as they are.
  virtual void copy_key(void* to, const void* from) const = 0;

  /// Size of the payload when written, without headers.
  virtual std::size_t encoded_bytes(const void* sample) const = 0;
};

/// Lives as long as the program. @pre `topic` is in topics.hpp
const SampleCodec& sample_codec(const std::string& topic);

}  // namespace aisle::bus
