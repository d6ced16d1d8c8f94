#include "tools/http/connection.h"

#include <algorithm>
#include <array>
#include <atomic>

namespace rapidc::http {

namespace {

constexpr std::size_t kReadSize = 16 * 1024;
constexpr std::size_t kWriteSize = 256 * 1024;
/// After a refusal the rest of what a client sends is read for so long, so that it can read the response.
constexpr std::chrono::seconds kLingerTime{2};

class Connection final : public Channel, public std::enable_shared_from_this<Connection> {
  public:
    Connection(std::shared_ptr<Hub> hub, Service& service, Stream stream, Peer peer)
        : hub_(std::move(hub)), service_(service), stream_(std::move(stream)), peer_(std::move(peer)),
          parser_(hub_->limits) {}

    void start() {
        allow(hub_->limits.headerTime);
        if (!stream_.tls()) return waitForRequest(true);
        stream_.tls()->async_handshake(asio::ssl::stream_base::server,
                                       [self = shared_from_this()](ErrorCode ec) {
                                           if (ec)
                                               self->end();
                                           else
                                               self->waitForRequest(true);
                                       });
    }

    Hub& hub() { return *hub_; }
    void abort() override { end(); }
    void tick(Clock::time_point now) override {
        if (now > deadline_) end();
    }
    std::optional<Clock::time_point> waitsSince() const override {
        if (phase_ != Phase::Waiting) return std::nullopt;
        return waitsSince_;
    }

  private:
    enum class Phase : uint8_t { Waiting, Reading, Answering, Writing, Lingering, Ended };

    void allow(Clock::duration time) { deadline_ = Clock::now() + time; }

    void end() {
        if (phase_ == Phase::Ended) return;
        phase_ = Phase::Ended;
        const auto self = shared_from_this();
        stream_.close();
        releaseBody();
        hub_->channels.erase(peer_.connection);
        if (!hub_->isStopping) service_.connectionEnded(peer_.connection);
    }
    void releaseBody() { hub_->bodyBytes -= std::exchange(heldBytes_, 0); }

    /// Before a request: the header must be complete some time after its first byte.
    void waitForRequest(bool isFirst) {
        phase_ = Phase::Waiting;
        waitsSince_ = Clock::now();
        hasHeaderTime_ = isFirst || parser_.hasBegun();
        allow(hasHeaderTime_ ? hub_->limits.headerTime : hub_->limits.idleTime);
        step();
    }

    void read() {
        stream_.async_read_some(asio::buffer(bytes_),
                                [self = shared_from_this()](ErrorCode ec, std::size_t size) {
                                    if (self->phase_ == Phase::Ended) return;
                                    if (ec) return self->end();
                                    self->received(size);
                                });
    }

    void received(std::size_t size) {
        if (phase_ == Phase::Waiting && !std::exchange(hasHeaderTime_, true)) allow(hub_->limits.headerTime);
        if (phase_ == Phase::Reading) {
            allow(hub_->limits.progressTime);
            bodyBytes_ += size;
            const auto slowest = std::chrono::seconds(bodyBytes_ / hub_->limits.bodyRate);
            if (Clock::now() - bodySince_ > hub_->limits.progressTime + slowest) return end();
        }
        parser_.feed(std::string_view(bytes_.data(), size));
        step();
    }

    void step() {
        switch (parser_.state()) {
        case RequestParser::State::Header: return read();
        case RequestParser::State::Decision: return decide();
        case RequestParser::State::Body:
            if (holdsTooMuch()) return refuse(503, "too many large requests at a time");
            return read();
        case RequestParser::State::Complete: return complete();
        case RequestParser::State::Failed: return refuse(parser_.status(), parser_.reason());
        }
    }

    bool holdsTooMuch() {
        const std::size_t now = parser_.bodyBytes();
        hub_->bodyBytes += now - heldBytes_;
        heldBytes_ = now;
        return hub_->bodyBytes > hub_->limits.allBodyBytes;
    }

    void decide() {
        phase_ = Phase::Reading;
        allow(hub_->limits.progressTime);
        bodySince_ = Clock::now();
        bodyBytes_ = 0;
        static_cast<Head&>(request_) = parser_.takeHead();
        request_.connection = peer_.connection;
        request_.peer = peer_.address;
        request_.secure = peer_.secure;
        Decision decision = service_.decide(request_);
        answer_ = std::move(decision.answer);
        request_.context = std::move(decision.context);
        if (decision.upgrade && !answer_) return upgrade(std::move(*decision.upgrade));
        const bool waitsForWord = request_.count("Expect") > 0 && request_.minorVersion > 0;
        if (answer_) {
            // A client that waits for "100 Continue" need not send its body any more.
            if (waitsForWord) return refuseWith(std::move(*answer_));
            parser_.dropBody();
        } else {
            parser_.keepBody(decision.bodyLimit);
            if (waitsForWord && parser_.state() == RequestParser::State::Body) return sendContinue();
        }
        step();
    }

    void sendContinue() {
        output_ = "HTTP/1.1 100 Continue\r\n\r\n";
        asio::async_write(stream_, asio::buffer(output_),
                          [self = shared_from_this()](ErrorCode ec, std::size_t) {
                              if (self->phase_ == Phase::Ended) return;
                              if (ec) return self->end();
                              self->step();
                          });
    }

    void upgrade(Upgrade upgrade) {
        if (request_.length.value_or(0) > 0 || request_.isChunked)
            return refuse(400, "a request for a socket has no body");
        parser_.dropBody();
        stream_.unread(parser_.takeRest());
        phase_ = Phase::Ended;
        serveSocket(hub_, service_, stream_, peer_, request_, std::move(upgrade));
    }

    void complete() {
        if (answer_) {
            Response answer = std::move(*answer_);
            answer_.reset();
            return respond(std::move(answer));
        }
        phase_ = Phase::Answering;
        allow(hub_->limits.answerTime);
        holdsTooMuch();
        request_.body = parser_.takeBody();
        isHead_ = request_.method == "HEAD";
        keepsAlive_ = request_.keepsAlive;
        service_.handle(std::move(request_), responder());
        request_ = {};
    }

    /// A function that answers from any thread, and answers 503 when it is dropped without having been called.
    Respond responder() {
        struct Promise {
            std::shared_ptr<Connection> connection;
            std::atomic<bool> isKept{false};
            void keep(Response response) {
                if (isKept.exchange(true)) return;
                const std::shared_ptr<Hub> hub = connection->hub_;
                asio::post(hub->io, [kept = std::move(connection), response = std::move(response)]() mutable {
                    if (kept->phase_ == Phase::Answering) kept->respond(std::move(response));
                });
            }
            ~Promise() {
                if (!isKept) keep(Response::text(503, "The request was dropped."));
            }
        };
        auto promise = std::make_shared<Promise>();
        promise->connection = shared_from_this();
        return [promise](Response response) { promise->keep(std::move(response)); };
    }

    void refuse(int status, const std::string& reason) { refuseWith(service_.refusal(status, reason)); }

    /// The connection ends: where the next request begins is not known.
    void refuseWith(Response response) {
        isHead_ = request_.method == "HEAD";
        keepsAlive_ = false;
        write(std::move(response));
    }

    void respond(Response response) {
        if (phase_ != Phase::Answering) {
            isHead_ = request_.method == "HEAD";
            keepsAlive_ = request_.keepsAlive;
        }
        if (response.closes) keepsAlive_ = false;
        write(std::move(response));
    }

    void write(Response response) {
        phase_ = Phase::Writing;
        releaseBody();
        output_ = headOf(response, keepsAlive_);
        if (!isHead_ && response.status != 204 && response.status != 304) output_ += response.body;
        written_ = 0;
        writeMore();
    }

    void writeMore() {
        allow(hub_->limits.progressTime);
        const std::size_t size = std::min(output_.size() - written_, kWriteSize);
        stream_.async_write_some(asio::buffer(output_.data() + written_, size),
                                 [self = shared_from_this()](ErrorCode ec, std::size_t count) {
                                     if (self->phase_ == Phase::Ended) return;
                                     if (ec) return self->end();
                                     self->written_ += count;
                                     if (self->written_ < self->output_.size())
                                         self->writeMore();
                                     else
                                         self->written();
                                 });
    }

    void written() {
        if (output_.capacity() > kWriteSize) output_ = {};
        if (!keepsAlive_) return closeGracefully();
        request_ = {};
        parser_.next();
        waitForRequest(false);
    }

    /// Ends our direction, then waits for the end of the other: a reset could reach the client before the response.
    void closeGracefully() {
        phase_ = Phase::Lingering;
        allow(kLingerTime);
        if (!stream_.tls()) return linger();
        stream_.tls()->async_shutdown([self = shared_from_this()](ErrorCode) {
            if (self->phase_ != Phase::Ended) self->linger();
        });
    }

    void linger() {
        ErrorCode ignored;
        stream_.socket().shutdown(Stream::Socket::shutdown_send, ignored);
        readToEnd();
    }

    void readToEnd() {
        stream_.socket().async_read_some(asio::buffer(bytes_),
                                         [self = shared_from_this()](ErrorCode ec, std::size_t) {
                                             if (self->phase_ == Phase::Ended) return;
                                             if (ec)
                                                 self->end();
                                             else
                                                 self->readToEnd();
                                         });
    }

    std::shared_ptr<Hub> hub_;
    Service& service_;
    Stream stream_;
    const Peer peer_;
    RequestParser parser_;
    Phase phase_ = Phase::Waiting;
    Clock::time_point deadline_, waitsSince_, bodySince_;
    std::size_t bodyBytes_ = 0; ///< received since bodySince_
    bool hasHeaderTime_ = false, isHead_ = false, keepsAlive_ = true;
    Request request_;
    std::optional<Response> answer_;
    std::size_t heldBytes_ = 0; ///< part of Hub::bodyBytes
    std::array<char, kReadSize> bytes_;
    std::string output_;
    std::size_t written_ = 0;
};

} // namespace

void serve(std::shared_ptr<Hub> hub, Service& service, Stream stream, Peer peer) {
    const uint64_t number = peer.connection;
    const auto connection =
        std::make_shared<Connection>(std::move(hub), service, std::move(stream), std::move(peer));
    connection->hub().channels[number] = connection;
    connection->start();
}

} // namespace rapidc::http
