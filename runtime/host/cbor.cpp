#include "runtime/host/cbor.h"

namespace rt {
namespace {

using Json = nlohmann::json;

/// Listens to a reader and ends it at this depth.
class DepthLimit final : public nlohmann::json_sax<Json> {
  public:
    bool null() override { return true; }
    bool boolean(bool) override { return true; }
    bool number_integer(number_integer_t) override { return true; }
    bool number_unsigned(number_unsigned_t) override { return true; }
    bool number_float(number_float_t, const string_t&) override { return true; }
    bool string(string_t&) override { return true; }
    bool binary(binary_t&) override { return true; }
    bool start_object(std::size_t) override { return ++depth_ <= kDeepest; }
    bool key(string_t&) override { return true; }
    bool end_object() override { return depth_-- > 0; }
    bool start_array(std::size_t) override { return ++depth_ <= kDeepest; }
    bool end_array() override { return depth_-- > 0; }
    bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override {
        return false;
    }

  private:
    static constexpr int kDeepest = 16;
    int depth_ = 0;
};

} // namespace

Json readCbor(std::string_view bytes) try {
    DepthLimit limit;
    const bool sound = Json::sax_parse(bytes.begin(), bytes.end(), &limit, Json::input_format_t::cbor);
    return sound ? Json::from_cbor(bytes) : Json(Json::value_t::discarded);
} catch (const Json::exception&) {
    return Json(Json::value_t::discarded);
}

std::string writeCbor(const Json& json) {
    std::string bytes;
    Json::to_cbor(json, bytes);
    return bytes;
}

Json binaryJson(std::string_view bytes) {
    return Json::binary({bytes.begin(), bytes.end()});
}

std::string bytesOf(const Json& binary) {
    const Json::binary_t& bytes = binary.get_binary();
    return {bytes.begin(), bytes.end()};
}

} // namespace rt
