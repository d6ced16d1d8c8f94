// libFuzzer target: a conversation with the language server. Must not crash or hang; every request has one answer, and what is sent
// is JSON.
//
// Each line is a message. One that begins with a letter is short for a request about the open document or for an edit of it:
// letter, line, comma, character, blank, text. Every other line is taken as the body of a frame.

#include "config/json_text.h"
#include "fuzz_support.h"
#include "tests/harness/plain_environment.h"
#include "tools/lsp/server.h"
#include "tools/protocol/framing.h"

#include <map>

namespace {

using namespace rapid;
using lsp::Json;

constexpr const char* kDocument = "untitled:fuzz";

/// A part of the library, so that a conversation stays short.
class SmallEnvironment final : public rapid::testing::PlainEnvironment {
  public:
    std::vector<sema::LibraryText> library(bool documented) const override {
        std::vector<sema::LibraryText> texts;
        for (const stdlib::StdlibSource& source : stdlib::sources())
            for (const char* name : {"decl/various", "decl/interrupts", "decl/io_signals", "data/"})
                if (std::string_view(source.name).starts_with(name))
                    texts.push_back({source.name, documented ? source.text : source.declarations});
        return texts;
    }
};

const std::map<char, const char*> kRequests = {{'a', "textDocument/codeAction"},
                                               {'b', "textDocument/documentHighlight"},
                                               {'c', "textDocument/completion"},
                                               {'d', "textDocument/definition"},
                                               {'e', "textDocument/typeDefinition"},
                                               {'f', "textDocument/formatting"},
                                               {'g', "textDocument/rangeFormatting"},
                                               {'h', "textDocument/hover"},
                                               {'i', "textDocument/implementation"},
                                               {'j', "textDocument/inlayHint"},
                                               {'k', "textDocument/codeLens"},
                                               {'l', "textDocument/documentLink"},
                                               {'m', "textDocument/prepareCallHierarchy"},
                                               {'n', "textDocument/onTypeFormatting"},
                                               {'o', "textDocument/documentSymbol"},
                                               {'p', "textDocument/prepareRename"},
                                               {'q', "textDocument/rename"},
                                               {'r', "textDocument/references"},
                                               {'s', "textDocument/signatureHelp"},
                                               {'t', "textDocument/semanticTokens/full"},
                                               {'u', "textDocument/foldingRange"},
                                               {'v', "textDocument/selectionRange"},
                                               {'w', "workspace/symbol"},
                                               {'x', "textDocument/diagnostic"}};

class Conversation {
  public:
    Conversation() : server_(environment_, [this](const Json& message) { sent(message); }) {
        say({{"id", "first"}, {"method", "initialize"}, {"params", {{"capabilities", Json::object()}}}});
        say({{"method", "initialized"}, {"params", Json::object()}});
        say({{"method", "textDocument/didOpen"},
             {"params",
              {{"textDocument",
                {{"uri", kDocument},
                 {"languageId", "rapid"},
                 {"version", 1},
                 {"text", "MODULE m\n  VAR num a;\n  PROC main()\n    a := 1;\n  ENDPROC\nENDMODULE\n"}}}}}});
    }

    void line(const std::string& text) {
        if (!text.empty() && (text[0] == '+' || kRequests.contains(text[0]))) return shorthand(text);
        Json message = config::tryParseJson(text);
        if (!message.is_discarded()) return hear(message);
        const size_t before = answered_;
        server_.receiveGarbage();
        answered_ = before; // not a request
    }

    void end() {
        server_.catchUp(true);
        fuzz::require(asked_ == answered_, "a request has no answer, or more than one");
    }

  private:
    void say(Json message) {
        message["jsonrpc"] = "2.0";
        hear(message);
    }
    void hear(const Json& message) {
        if (server_.hasEnded()) return;
        const bool request = message.is_object() && message.contains("method") && message.contains("id") &&
                             (message["id"].is_string() || message["id"].is_number_integer()) &&
                             message["method"].is_string() && message.value("jsonrpc", Json()) == "2.0";
        const size_t before = answered_;
        server_.receive(message);
        if (request) ++asked_;
        if (!request) answered_ = before; // refusals of other messages
    }
    void sent(const Json& message) {
        fuzz::require(!config::tryParseJson(config::textOf(message)).is_discarded(),
                      "the server sends what is not JSON");
        if (!message.contains("method")) ++answered_;
    }
    void shorthand(const std::string& text) {
        char* rest = nullptr;
        const long line = std::strtol(text.c_str() + 1, &rest, 10);
        const long character = *rest == ',' ? std::strtol(rest + 1, &rest, 10) : 0;
        const std::string word = *rest == ' ' ? rest + 1 : "";
        const Json position{{"line", line}, {"character", character}};
        const Json range{{"start", position}, {"end", {{"line", line}, {"character", character + 4}}}};
        Json params{{"textDocument", {{"uri", kDocument}, {"version", ++version_}}},
                    {"position", position},
                    {"range", range}};
        if (text[0] == '+') {
            params["contentChanges"] = Json::array({{{"range", range}, {"text", word}}});
            return say({{"method", "textDocument/didChange"}, {"params", std::move(params)}});
        }
        params["positions"] = Json::array({position});
        params["newName"] = word;
        params["query"] = word;
        params["ch"] = "\n";
        params["options"] = Json::object();
        params["context"] = {{"includeDeclaration", true}, {"diagnostics", Json::array()}};
        say({{"id", version_}, {"method", kRequests.at(text[0])}, {"params", std::move(params)}});
    }

    SmallEnvironment environment_;
    size_t asked_ = 0, answered_ = 0;
    int version_ = 1;
    lsp::Server server_;
};

/// The same bytes as frames, in pieces.
void readFrames(const std::string& bytes) {
    using protocol::FrameReader;
    FrameReader reader(FrameReader::Stray::Skipped);
    std::string body;
    for (size_t at = 0; at < bytes.size(); at += 7) {
        reader.add(std::string_view(bytes).substr(at, 7));
        while (reader.next(body) == FrameReader::Result::Message)
            fuzz::require(body.size() <= bytes.size(), "a body is longer than what was read");
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    constexpr size_t kMost = 1 << 12;
    if (size > kMost) return 0;
    const std::string bytes(reinterpret_cast<const char*>(data), size);
    readFrames(bytes);
    Conversation conversation;
    for (size_t from = 0; from < bytes.size();) {
        const size_t end = std::min(bytes.find('\n', from), bytes.size());
        conversation.line(bytes.substr(from, end - from));
        from = end + 1;
    }
    conversation.end();
    return 0;
}
