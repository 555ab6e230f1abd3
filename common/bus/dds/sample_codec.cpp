#include "common/bus/sample_codec.hpp"

#include <cassert>
#include <map>
#include <utility>

#include "common/bus/dds/fastdds_compat.hpp"
#include "common/bus/dds/type_table.hpp"

namespace aisle::bus {
namespace {

/// A codec by a row of the type table.
class TableCodec final : public SampleCodec {
 public:
  explicit TableCodec(const TopicType& type)
      : type_(type), support_(type.make_support()), topic_(type.name), type_name_(support_.get_type_name()) {}

  const std::string& topic() const override { return topic_; }
  const std::string& type_name() const override { return type_name_; }
  const Qos& qos() const override { return type_.qos; }

  AnySample new_sample() const override {
    fast::Sample made = fast::new_sample(support_);
    auto deleter = made.get_deleter();
    return AnySample(made.release(), std::move(deleter));
  }

  bool encode(const void* sample, std::vector<std::uint8_t>& bytes) const override {
    return fast::encode(support_, sample, bytes);
  }

  bool decode(const std::vector<std::uint8_t>& bytes, void* sample) const override {
    return fast::decode(support_, bytes, sample);
  }

  void key(const void* sample, std::string& key) const override {
    key.clear();
    type_.append_key(const_cast<void*>(sample), key);
  }

  void copy_key(void* to, const void* from) const override { type_.copy_key(to, const_cast<void*>(from)); }
  std::size_t encoded_bytes(const void* sample) const override { return fast::serialized_bytes(support_, sample); }

 private:
  const TopicType& type_;
  fast::dds::TypeSupport support_;
  std::string topic_, type_name_;
};

}  // namespace

const SampleCodec& sample_codec(const std::string& topic) {
  static const std::map<std::string, TableCodec> codecs = [] {
    std::map<std::string, TableCodec> made;
    for (const TopicType& type : all_topic_types()) made.try_emplace(type.name, type);
    return made;
  }();

  const auto found = codecs.find(topic);
  assert(found != codecs.end() && "not in topics.hpp");

  return found->second;
}

}  // namespace aisle::bus
