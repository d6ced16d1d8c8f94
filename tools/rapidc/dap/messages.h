#pragma once
// Messages of the debug adapter protocol: arguments of requests, checked, and what is sent.

#include "config/json_text.h"
#include "tools/protocol/framing.h"

#include <cstdint>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace rapidc::dap {

using Json = nlohmann::json;

/// A request is not carried out; the text goes into its answer.
struct Refusal : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The arguments of a request. All functions throw a Refusal when a value is missing or of a different type.
class Arguments {
  public:
    /// `json` must outlive this; anything but an object counts as one without members. `prefix`: its place, for people.
    explicit Arguments(const Json& json, std::string prefix = "");

    bool has(const char* name) const;
    /// Refuses the request when the argument is missing.
    void require(const char* name) const;
    std::string text(const char* name) const;
    std::string text(const char* name, const std::string& otherwise) const;
    bool flag(const char* name, bool otherwise) const;
    int64_t number(const char* name) const;
    int64_t number(const char* name, int64_t otherwise) const;
    std::vector<std::string> texts(const char* name) const;
    /// Empty when it is not given.
    Arguments object(const char* name) const;
    std::vector<Arguments> objects(const char* name) const;
    std::vector<int64_t> numbers(const char* name) const;

  private:
    const Json* find(const char* name) const;
    [[noreturn]] void refuse(const char* name, const char* wanted) const;
    static int64_t wholeNumber(const Json& json, const std::string& name);

    const Json& json_;
    std::string prefix_;
};

/// How the client counts and what it understands.
struct ClientFacts {
    bool linesStartAt1 = true, columnsStartAt1 = true;
    bool usesUris = false;
    bool showsProgress = false;

    int64_t lineOut(uint32_t line) const { return static_cast<int64_t>(line) - (linesStartAt1 ? 0 : 1); }
    int64_t columnOut(uint32_t column) const {
        return static_cast<int64_t>(column) - (columnsStartAt1 ? 0 : 1);
    }
    /// Lines that no text has become the first one.
    uint32_t lineIn(int64_t line) const;
    /// As sources name it: the path itself or a URI.
    std::string pathOut(const std::string& path) const;
};

struct Request {
    int64_t seq = 0;
    std::string command;
    Json arguments;
};

/// The other side. From any thread.
class Client {
  public:
    explicit Client(protocol::Channel& channel) : channel_(channel) {}

    void answer(const Request& request, Json body);
    void refuse(const Request& request, const std::string& message);
    void event(const char* name, Json body);
    /// Of category console, stdout, important ...; a line end is added.
    void output(const char* category, std::string_view text);
    void output(const char* category, std::string_view text, Json place);
    bool hasGone() const { return gone_; }

  private:
    void send(Json message);

    protocol::Channel& channel_;
    std::mutex mutex_;
    int64_t seq_ = 0;
    bool gone_ = false;
};

} // namespace rapidc::dap
