#pragma once
// Request and Reply of Robot Web Services, independent of dialect, HTTP library and threads. A handler gets a Request and returns
// a Reply; rendering (render.h) turns the Reply into XHTML, JSON of RWS 1.0 or HAL JSON of RWS 2.0.

#include "tools/rws/return_code.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rapidc::rws {

enum class Dialect : uint8_t {
    V1, ///< RWS 1.0: HTTP, digest login
    V2, ///< RWS 2.0: HTTPS, basic login
};

enum class Method : uint8_t { Get, Post, Put, Delete };

/// A client that has logged on; lives until logout, idle end or shutdown. Only its constants may be read from all threads.
struct Session {
    uint64_t number = 0; ///< never used twice
    Dialect dialect = Dialect::V1;
    std::string user;
    std::string address;   ///< of the client: "127.0.0.1"
    uint64_t restarts = 0; ///< of the controller, before it was logged on: the next one ends it
};

/// Values by name, as decoded from a query or a form. A name may come more than once.
class Fields {
  public:
    void add(std::string name, std::string value) { fields_.emplace_back(std::move(name), std::move(value)); }
    /// The first value of that name; "" when there is none. Names are compared without regard to case.
    std::string text(std::string_view name) const;
    bool has(std::string_view name) const;
    const std::vector<std::pair<std::string, std::string>>& all() const { return fields_; }

  private:
    std::vector<std::pair<std::string, std::string>> fields_;
};

struct Request {
    Dialect dialect = Dialect::V1;
    Method method = Method::Get;
    std::string path;                  ///< decoded, begins with '/', no '/' at the end (except "/")
    std::vector<std::string> segments; ///< of the path, decoded one by one
    std::string action;                ///< ?action= of RWS 1.0
    Fields query, form;
    std::string body;        ///< raw bytes
    std::string contentType; ///< without parameters, lower case
    std::string base; ///< "http://127.0.0.1:8080", from the connection, escaped where it came from the client
    std::shared_ptr<const Session> session;
    uint64_t connection = 0; ///< number of the TCP connection (RWS 1.0 ties mastership to it)
    /// Filled by the router from {name} and {name*} of the pattern.
    std::map<std::string, std::string, std::less<>> parameters;

    const std::string& parameter(std::string_view name) const;
};

/// One li of XHTML, one object of JSON.
struct Entry {
    std::string type;  ///< class, "pnl-opmode"
    std::string title; ///< may repeat a path
    std::string self;  ///< href of rel=self, relative to the base; "" = none
    std::vector<std::pair<std::string, std::string>> values; ///< spans, in order; each name once
    std::vector<std::pair<std::string, std::string>> links;  ///< further anchors: rel, href
    /// Entries inside this one (attributes of a cfg instance); `nestedName` is their member in HAL JSON ("attrib").
    std::vector<Entry> nested;
    std::string nestedName;
    bool isNestedOnlyInJson =
        false; ///< where the spans of XHTML say the same, and clients take each li for an entry

    std::string numberInJson = {}; ///< the value that is a number and no text in JSON of RWS 1.0; "" = none

    Entry& value(std::string name, std::string text) {
        values.emplace_back(std::move(name), std::move(text));
        return *this;
    }
};

/// A resource that is described: everything but files.
struct Document {
    /// The member of RWS 2.0 that holds the entries.
    enum class Place : uint8_t { State, Resources };
    Place place = Place::State;
    std::vector<Entry> entries;
    std::string self; ///< href of rel=self; "" = the path of the request
    std::string next; ///< href of the next page; "" = none
    std::vector<std::pair<std::string, std::string>> links; ///< further anchors: rel, href

    Entry& add(std::string type, std::string title) {
        entries.push_back({std::move(type), std::move(title), {}, {}, {}, {}, {}});
        return entries.back();
    }
};

/// Bytes as they are: contents of files.
struct Raw {
    std::string contentType = "application/octet-stream";
    std::string bytes;
};

/// An error with its return code; the HTTP status is the one of the code unless another is given.
struct Failure {
    ReturnCode code = ReturnCode::Rejected;
    std::string message; ///< for people: place and remedy
    int status = 0;      ///< 0: as the code says
};

struct Reply {
    int status = 200;
    std::optional<Document> document;
    std::optional<Raw> raw;
    std::optional<Failure> failure;
    std::string location; ///< header, "" = none

    static Reply of(Document document, int status = 200);
    static Reply of(Raw raw);
    /// Success without a body: 204.
    static Reply done(int status = 204);
    static Reply refuse(ReturnCode code, std::string message, int status = 0);
    static Reply refuse(const Failure& failure) {
        return refuse(failure.code, failure.message, failure.status);
    }
};

} // namespace rapidc::rws
