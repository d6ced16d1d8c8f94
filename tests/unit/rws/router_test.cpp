#include "tools/rws/router.h"
#include "tools/rws/subscribable.h"

#include <catch2/catch.hpp>

using namespace rapidc::rws;

namespace {

Handler named(const std::string& name) {
    return [name](const Request&) { return Reply::refuse(ReturnCode::Rejected, name); };
}

Request requestOf(Method method, const std::string& path, Dialect dialect = Dialect::V1,
                  std::string action = {}) {
    Request request;
    request.dialect = dialect;
    request.method = method;
    request.path = path;
    request.segments = splitPath(path);
    request.action = std::move(action);
    return request;
}

/// The name of the handler that answers; "" when there is none.
std::string answering(const Router& router, Request request) {
    const Router::Match match = router.find(request);
    return match.route ? match.route->handler(request).failure->message : "";
}

} // namespace

TEST_CASE("Fixed segments win over parameters, those over the rest of a path", "[rws]") {
    Router router;
    router.get(Dialect::V1, "/files/{path*}", named("rest"));
    router.get(Dialect::V1, "/tasks/{task}/{what}", named("two"));
    router.get(Dialect::V1, "/tasks/{task}/pcp", named("pcp"));
    router.get(Dialect::V1, "/signals/{name*}", named("signal"));
    router.get(Dialect::V1, "/signals/{name*}/set-value", named("set"));
    router.get(Dialect::V1, "/signals/first", named("first"));
    router.get(Dialect::V1, "/", named("root"));

    CHECK(answering(router, requestOf(Method::Get, "/files/a/b/c")) == "rest");
    CHECK(answering(router, requestOf(Method::Get, "/files")).empty());
    CHECK(answering(router, requestOf(Method::Get, "/tasks/T/x")) == "two");
    CHECK(answering(router, requestOf(Method::Get, "/tasks/T/pcp")) == "pcp");
    CHECK(answering(router, requestOf(Method::Get, "/signals/net/dev/name")) == "signal");
    CHECK(answering(router, requestOf(Method::Get, "/signals/net/dev/name/set-value")) == "set");
    CHECK(answering(router, requestOf(Method::Get, "/signals/first")) == "first");
    CHECK(answering(router, requestOf(Method::Get, "/")) == "root");
    CHECK(answering(router, requestOf(Method::Get, "/unknown")).empty());
}

TEST_CASE("Letter case matters in parameters only (controller.md 2.1)", "[rws]") {
    Router router;
    router.get(Dialect::V1, "/rw/cfg/{domain}/{type}/instances", named("instances"));
    Request request = requestOf(Method::Get, "/RW/cfg/MOC/Joint/INSTANCES");
    REQUIRE(router.find(request).route);
    CHECK(request.parameter("domain") == "MOC");
    CHECK(request.parameter("type") == "Joint");
    CHECK(request.parameter("other").empty());
}

TEST_CASE("The rest of a path is joined, and a slash inside a segment stays (serve-contract 28)", "[rws]") {
    Router router;
    router.get(Dialect::V2, "/rw/rapid/symbol/{path*}/properties", named("properties"));
    for (const std::vector<std::string>& segments :
         {std::vector<std::string>{"rw", "rapid", "symbol", "RAPID/T/M/x", "properties"},
          {"rw", "rapid", "symbol", "RAPID", "T", "M", "x", "properties"}}) {
        Request request = requestOf(Method::Get, "", Dialect::V2);
        request.segments = segments;
        REQUIRE(router.find(request).route);
        CHECK(request.parameter("path") == "RAPID/T/M/x");
    }
}

TEST_CASE("Actions choose the route of a POST in RWS 1.0 (controller.md 2.1)", "[rws]") {
    Router router;
    router.post(Dialect::V1, "/x", named("plain"));
    router.action("/x", "set", named("set"));
    router.post(Dialect::V2, "/x", named("plain2"));
    router.get(Dialect::V1, "/x", named("get"));
    CHECK(answering(router, requestOf(Method::Post, "/x")) == "plain");
    CHECK(answering(router, requestOf(Method::Post, "/x", Dialect::V1, "SET")) == "set");
    CHECK(answering(router, requestOf(Method::Post, "/x", Dialect::V1, "other")).empty());
    CHECK(answering(router, requestOf(Method::Post, "/x", Dialect::V2, "other")) == "plain2");
    CHECK(answering(router, requestOf(Method::Get, "/x", Dialect::V1, "show")) == "get");

    Request unknown = requestOf(Method::Post, "/x", Dialect::V1, "other");
    CHECK(router.find(unknown).methodKnown);
    Request wrongMethod = requestOf(Method::Delete, "/x");
    CHECK(router.find(wrongMethod).pathKnown);
    CHECK_FALSE(router.find(wrongMethod).methodKnown);
}

TEST_CASE("A later route replaces an earlier one", "[rws]") {
    Router router;
    router.getBoth("/a/{one}", named("early"));
    router.getBoth("/a/{two}", named("late"));
    CHECK(answering(router, requestOf(Method::Get, "/a/b")) == "late");
    CHECK(answering(router, requestOf(Method::Get, "/a/b", Dialect::V2)) == "late");
}

TEST_CASE("A subscription is found by path and resource (serve-contract 44)", "[rws]") {
    Subscribables all;
    all.add({"/rw/panel/opmode", "", false, {}, {}});
    all.add({"/rw/iosystem/signals/{name*}", "state", true, {}, {}});
    all.add({"/rw/panel/ctrlstate", "", false, Dialect::V1, {}});
    Request request;
    CHECK(all.find("/rw/panel/opmode", request) == &all.all()[0]);
    CHECK(all.find("/rw/panel/opmode;opmode", request) == &all.all()[0]);
    CHECK(all.find("/rw/panel/opmode;state", request) == nullptr);
    CHECK(all.find("/rw/iosystem/signals/n/d/do1;state", request) == &all.all()[1]);
    CHECK(request.parameter("name") == "n/d/do1");
    CHECK(request.path == "/rw/iosystem/signals/n/d/do1");
    CHECK(all.find("/rw/iosystem/signals/do1", request) == nullptr);
    for (const char* text : {"", ";", "/", "/;", "opmode", "/rw"})
        CHECK(all.find(text, request) == nullptr);
    request.dialect = Dialect::V2;
    CHECK(all.find("/rw/panel/ctrlstate", request) == nullptr);
}

TEST_CASE("Refusals carry the status of their code", "[rws]") {
    CHECK(Reply::refuse(ReturnCode::NotFound, "x").status == 404);
    CHECK(Reply::refuse(ReturnCode::NotFound, "x", 400).status == 400);
    CHECK(describe(-1073445862)->status == 403);
    CHECK_FALSE(describe(1));
    Fields fields;
    fields.add("Mode", "a");
    fields.add("mode", "b");
    CHECK(fields.text("MODE") == "a");
    CHECK(fields.has("mode"));
    CHECK_FALSE(fields.has("m"));
}
