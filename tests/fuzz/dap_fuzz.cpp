// libFuzzer target: a conversation with the debug adapter, which executes a program. Must not crash or hang; every request has one
// answer, a refusal has a message, messages are numbered in order, and the session ends when the client disconnects.
//
// The first byte chooses the program, which may have two tasks. Each line is a message. One that begins with a letter is short for a
// request: letter, number, comma, number, blank, text; an odd second number is of the second task. Every other line is taken as it is.

#include "config/json_text.h"
#include "fuzz_support.h"
#include "tools/protocol/framing.h"
#include "tools/rapidc/dap/session.h"

#include <chrono>
#include <map>
#include <poll.h>
#include <set>
#include <string_view>
#include <thread>
#include <unistd.h>

namespace {

using namespace rapid;
using Json = nlohmann::json;
using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;
using std::chrono::seconds;

/// The meaning of one line of the input.
struct Words {
    char letter = 0;
    int64_t number = 0, second = 0;
    std::string text;
};

Json frameOf(const Words& words) {
    return {{"frameId", words.number}, {"threadId", 1 + words.second % 2}};
}

/// Arguments of the requests that have a letter; the adapter ignores those that a request has no use for.
Json argumentsOf(const Words& words, const std::string& program) {
    Json all = frameOf(words);
    const size_t equals = words.text.find('=');
    const std::string left = words.text.substr(0, equals);
    const std::string right = equals == std::string::npos ? "" : words.text.substr(equals + 1);
    all["variablesReference"] = words.number;
    all["expression"] = words.letter == 'q' ? left : words.text;
    static const char* const kContexts[] = {"watch", "hover", "repl", "clipboard"};
    all["context"] = kContexts[static_cast<size_t>(words.second) % 4];
    all["name"] = left;
    all["value"] = right;
    all["text"] = words.text;
    all["column"] = words.second;
    all["line"] = words.number;
    all["targetId"] = words.number;
    all["start"] = words.second;
    all["source"] = {{"path", program}};
    all["granularity"] = words.text == "move" ? "move" : "statement";
    all["filters"] = words.text.empty() ? Json::array() : Json::array({words.text});
    Json breakpoint{{"line", words.number}, {"name", words.text}, {"dataId", words.text}};
    if (words.letter == 'b' && !words.text.empty()) breakpoint["condition"] = words.text;
    if (words.letter == 'l') breakpoint["logMessage"] = words.text;
    if (words.letter == 'b' && words.second > 0) breakpoint["hitCondition"] = std::to_string(words.second);
    all["breakpoints"] = Json::array({std::move(breakpoint)});
    return all;
}

const std::map<char, const char*> kRequests = {{'a', "stepIn"},
                                               {'b', "setBreakpoints"},
                                               {'c', "continue"},
                                               {'d', "dataBreakpointInfo"},
                                               {'e', "evaluate"},
                                               {'f', "setFunctionBreakpoints"},
                                               {'g', "gotoTargets"},
                                               {'h', "goto"},
                                               {'i', "scopes"},
                                               {'j', "variables"},
                                               {'k', "setVariable"},
                                               {'l', "setBreakpoints"},
                                               {'m', "completions"},
                                               {'n', "next"},
                                               {'o', "stepOut"},
                                               {'p', "pause"},
                                               {'q', "setExpression"},
                                               {'r', "restart"},
                                               {'s', "stackTrace"},
                                               {'t', "threads"},
                                               {'u', "restartFrame"},
                                               {'v', "stepBack"},
                                               {'w', "reverseContinue"},
                                               {'x', "exceptionInfo"},
                                               {'y', "setExceptionBreakpoints"},
                                               {'z', "setDataBreakpoints"}};
constexpr std::string_view kOrders = "acnorhuvw"; ///< after these the program executes

std::string pathOf(const std::string& name) {
    return RAPIDC_SOURCE_DIR "/tests/cli/dap/" + name + ".modx";
}

/// A program, and its second task when it has one.
struct Program {
    const char* name;
    const char* task = "";
    const char* second = "";
};

Program programOf(char choice) {
    static const Program kPrograms[] = {{"part"},
                                        {"errors"},
                                        {"moves"},
                                        {"traps"},
                                        {"endless"},
                                        {"frames"},
                                        {"together_a", "T_ROB2", "together_b"},
                                        {"two_a", "T_B:STATIC", "two_b"}};
    return kPrograms[static_cast<unsigned char>(choice) % std::size(kPrograms)];
}

/// The client: sends one line after the other, each when the one before has its answer.
class Conversation {
  public:
    Conversation(rt::Inbox& inbox, rapidc::dap::Session& session, int input)
        : inbox_(inbox), session_(session), input_(input) {}

    void hold(const std::string& bytes) {
        const Program chosen = programOf(bytes.empty() ? '\0' : bytes[0]);
        const std::string program = pathOf(chosen.name);
        Json launch{{"program", program}, {"stopOnEntry", true}};
        if (*chosen.second != '\0')
            launch["tasks"] = Json::array({std::string(chosen.task) + "=" + pathOf(chosen.second)});
        ask("initialize", Json::object());
        ask("launch", std::move(launch));
        ask("configurationDone", Json::object());
        waitFor([this] { return stops_ > 0; });
        for (size_t from = 1; from < bytes.size() && !gone_;) {
            const size_t end = std::min(bytes.find('\n', from), bytes.size());
            line(bytes.substr(from, end - from), program);
            from = end + 1;
        }
        if (!gone_) ask("disconnect", Json::object());
        while (!closed_)
            listen(kHang);
    }

  private:
    static constexpr seconds kHang{60};
    static constexpr milliseconds kRun{20};

    void line(const std::string& text, const std::string& program) {
        if (text.empty() || !kRequests.contains(text[0])) return raw(text);
        Words words{text[0], 0, 0, ""};
        char* rest = nullptr;
        words.number = std::strtol(text.c_str() + 1, &rest, 10);
        if (*rest == ',') words.second = std::abs(std::strtol(rest + 1, &rest, 10) % 100000);
        if (*rest == ' ') words.text = rest + 1;
        const size_t before = stops_;
        ask(kRequests.at(words.letter), argumentsOf(words, program));
        if (kOrders.find(words.letter) != std::string_view::npos) waitFor([&] { return stops_ > before; });
    }

    /// Whatever it is: when it is a request with a number, its answer is waited for.
    void raw(const std::string& text) {
        const Json message = config::tryParseJson(text);
        if (!message.is_object() || message.value("type", Json()) != "request") return send(text);
        ask(message.value("command", Json()).is_string() ? message.value("command", std::string()) : "",
            message.value("arguments", Json()));
    }

    void ask(const std::string& command, Json arguments) {
        const int64_t seq = ++lastSeq_;
        if (command == "disconnect") gone_ = true;
        const Json request{
            {"seq", seq}, {"type", "request"}, {"command", command}, {"arguments", std::move(arguments)}};
        send(config::textOf(request));
        while (!answered_.contains(seq) && !closed_)
            listen(kHang);
        fuzz::require(answered_.contains(seq), "a request has no answer");
    }

    void send(const std::string& text) {
        inbox_.post([this, text] { session_.take(text); });
    }

    template <class Done> void waitFor(const Done& done) {
        const Clock::time_point end = Clock::now() + kRun;
        while (!done() && !closed_ && Clock::now() < end)
            listen(kRun);
    }

    /// Takes what the adapter sends next.
    void listen(milliseconds patience) {
        pollfd ready{input_, POLLIN, 0};
        const int count = ::poll(&ready, 1, static_cast<int>(patience.count()));
        fuzz::require(count > 0 || patience < kHang, "the adapter hangs");
        if (count <= 0) return;
        char bytes[4096];
        const ssize_t got = ::read(input_, bytes, sizeof bytes);
        if (got <= 0) {
            closed_ = true;
            return;
        }
        frames_.add(std::string_view(bytes, static_cast<size_t>(got)));
        std::string body;
        while (frames_.next(body) == protocol::FrameReader::Result::Message)
            take(config::tryParseJson(body));
    }

    void take(const Json& message) {
        fuzz::require(message.is_object() && message.value("seq", int64_t{0}) == ++lastReceived_,
                      "messages are not numbered in order");
        const std::string type = message.value("type", "");
        if (type == "event") {
            const std::string name = message.value("event", "");
            if (name == "stopped" || name == "terminated") ++stops_;
            return;
        }
        fuzz::require(type == "response", "a message of unknown type");
        const auto seq = message.value("request_seq", int64_t{0});
        fuzz::require(message.value("success", false) || !message.value("message", "").empty(),
                      "a refusal has no message");
        if (seq == 0) return; // of what is not a request
        fuzz::require(seq <= lastSeq_ && answered_.insert(seq).second, "an answer that was not asked for");
    }

    rt::Inbox& inbox_;
    rapidc::dap::Session& session_;
    int input_;
    protocol::FrameReader frames_;
    std::set<int64_t> answered_;
    int64_t lastSeq_ = 0, lastReceived_ = 0;
    size_t stops_ = 0;
    bool gone_ = false, closed_ = false;
};

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    constexpr size_t kMost = 1 << 11;
    if (size > kMost) return 0;
    int ends[2];
    fuzz::require(::pipe(ends) == 0, "no pipe");
    {
        protocol::Channel channel(-1, ends[1]);
        rt::Inbox inbox;
        rapidc::dap::StrayOutput stray(ends[1]);
        rapidc::dap::Session session(channel, inbox, stray);
        Conversation conversation(inbox, session, ends[0]);
        std::thread client([&] { conversation.hold(fuzz::bytesOf(data, size)); });
        fuzz::require(session.run() == 0, "the session ends with an error");
        ::close(ends[1]);
        client.join();
    }
    ::close(ends[0]);
    return 0;
}
