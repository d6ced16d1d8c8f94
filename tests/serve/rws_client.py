"""Clients of Robot Web Services for tests: RwsClient (both dialects), RawClient (bytes), SocketClient (WebSocket)."""

import base64
import hashlib
import http.client
import json
import os
import re
import socket
import ssl
import struct
import time
import urllib.parse
import xml.etree.ElementTree as xml

HAL = "application/hal+json;v=2.0"
XHTML2 = "application/xhtml+xml;v=2.0"
FORM = "application/x-www-form-urlencoded"
TIMEOUT = 30


def unchecked_context():
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
    context.check_hostname = False
    context.verify_mode = ssl.CERT_NONE
    return context


class Entry:
    """One li of XHTML or one object of JSON."""

    def __init__(self, type_, title, values, links, nested=()):
        self.type, self.title, self.values, self.links, self.nested = type_, title, values, links, list(nested)

    def __repr__(self):
        return f"<{self.type} {self.title!r} {self.values}>"

    def __eq__(self, other):
        return (self.type, self.title, self.values, self.nested) == (other.type, other.title, other.values, other.nested)


def _name(element):
    return element.tag.rsplit("}", 1)[-1]


def _anchors(element):
    return {a.get("rel"): a.get("href") for a in element if _name(a) == "a"}


def _entry_of_li(li):
    spans = [span for span in li if _name(span) == "span"]
    values = {span.get("class"): "".join(span.itertext()) for span in spans}
    if len(values) != len(spans):
        raise AssertionError("a name of a span comes twice in an li")
    nested = [_entry_of_li(inner) for ul in li if _name(ul) == "ul" for inner in ul]
    return Entry(li.get("class"), li.get("title"), values, _anchors(li), nested)


def read_xhtml(text):
    """The division of an XHTML document: (its class, entries, links, spans)."""
    root = xml.fromstring(text)
    body = next(element for element in root if _name(element) == "body")
    division = next(element for element in body if _name(element) == "div")
    entries = [_entry_of_li(li) for ul in division if _name(ul) == "ul" for li in ul]
    spans = {span.get("class"): "".join(span.itertext()) for span in division if _name(span) == "span"}
    return division.get("class"), entries, _anchors(division), spans


def _no_doubles(pairs):
    names = [name for name, _ in pairs]
    if len(names) != len(set(names)):
        raise AssertionError(f"a member comes twice: {names}")
    return dict(pairs)


def _entry_of_json(item):
    links = {rel: link["href"] for rel, link in item.get("_links", {}).items()}
    nested, values = [], {}
    for name, value in item.items():
        if isinstance(value, list):
            nested += [_entry_of_json(inner) for inner in value]
        elif name not in ("_links", "_type", "_title"):
            values[name] = value if isinstance(value, str) else json.dumps(value)  # signals of RWS 1.0
    return Entry(item.get("_type"), item.get("_title"), values, links, nested)


class Response:
    """A response with the same view of XHTML, JSON of RWS 1.0 and HAL JSON."""

    def __init__(self, status, headers, body):
        self.status, self.headers, self.body = status, headers, body

    def header(self, name):
        return next((value for key, value in self.headers if key.lower() == name.lower()), None)

    def cookies(self):
        pairs = [value.split(";")[0].split("=", 1) for key, value in self.headers if key.lower() == "set-cookie"]
        return {name.strip(): value.strip() for name, value in pairs}

    def json(self):
        return json.loads(self.body, object_pairs_hook=_no_doubles)

    def is_json(self):
        return "json" in (self.header("content-type") or "")

    def entries(self, type_=None):
        if self.is_json():
            root = self.json()
            embedded = root.get("_embedded", {})
            items = root.get("state", []) + embedded.get("_state", []) + embedded.get("resources", [])
            found = [_entry_of_json(item) for item in items]
        else:
            found = read_xhtml(self.body)[1]
        return [entry for entry in found if type_ is None or entry.type == type_]

    def values(self, type_=None):
        """The values of the first entry."""
        found = self.entries(type_)
        if not found:
            raise AssertionError(f"no entry {type_ or ''} in {self.status} {self.body[:500]!r}")
        return found[0].values

    def links(self):
        if self.is_json():
            return {rel: link["href"] for rel, link in self.json()["_links"].items()}
        return read_xhtml(self.body)[2]

    def base(self):
        """The address that relative ones count from."""
        if self.is_json():
            return self.json()["_links"]["base"]["href"]
        return next(element.get("href") for element in xml.fromstring(self.body).iter() if _name(element) == "base")

    def following(self):
        """Path and query of the next page, which may be relative to the base; None on the last one."""
        address = self.links().get("next")
        if not address:
            return None
        parts = urllib.parse.urlsplit(urllib.parse.urljoin(self.base(), address.replace("&amp;", "&")))
        return f"{parts.path}?{parts.query}"

    def code(self):
        """The return code of an error."""
        if not self.is_json():
            return int(read_xhtml(self.body)[3]["code"])
        root = self.json()
        return (root.get("status") or root["_embedded"]["status"])["code"]

    def __repr__(self):
        return f"<{self.status} {self.body[:500]!r}>"


class RwsClient:
    """A client of one dialect on one connection. It logs on when it is asked to, and uses the cookies from then on."""

    def __init__(self, address, dialect, user="Default User", password="robotics", form=None):
        parts = urllib.parse.urlsplit(address)
        self.address, self.host, self.port = address, parts.hostname, parts.port
        self.dialect, self.user, self.password = dialect, user, password
        self.form = form or ("xhtml" if dialect == 1 else "hal")  # or "json" of RWS 1.0, "xhtml" of RWS 2.0
        self.cookies, self.connection, self.counter = {}, None, 0

    # ---- Requests ----------------------------------------------------------------------------------------------------

    def get(self, path, **options):
        return self.request("GET", path, **options)

    def post(self, path, fields=None, **options):
        return self.request("POST", path, fields=fields, **options)

    def put(self, path, body=None, fields=None, **options):
        return self.request("PUT", path, body=body, fields=fields, **options)

    def delete(self, path, **options):
        return self.request("DELETE", path, **options)

    def act(self, path, action, fields=None, action2=None):
        """An action in the way of the dialect: POST path?action=NAME or POST path/NAME."""
        if self.dialect == 1:
            return self.post(path + ("&" if "?" in path else "?") + "action=" + action, fields)
        return self.post(f"{path}/{action2 or action}", fields)

    def request(self, method, path, fields=None, body=None, headers=None, login=True):
        """One request. `fields`: a form (a dict or pairs); `login`: logs on when the server asks for it."""
        headers = dict(headers or {})
        if self.dialect == 2:
            headers.setdefault("Accept", HAL if self.form == "hal" else XHTML2)
        elif self.form == "json":
            path += ("&" if "?" in path else "?") + "json=1"
        if fields is not None:
            body = urllib.parse.urlencode(fields)
            headers.setdefault("Content-Type", FORM + (";v=2.0" if self.dialect == 2 else ""))
        elif method == "POST" and self.dialect == 2:
            headers.setdefault("Content-Type", FORM + ";v=2.0")
        if self.cookies:
            headers.setdefault("Cookie", "; ".join(f"{name}={value}" for name, value in self.cookies.items()))
        elif self.dialect == 2 and login:
            headers.setdefault("Authorization", self.basic())
        response = self.send(method, path, body, headers)
        if response.status == 401 and login and "Authorization" not in headers and self.dialect == 1:
            headers.pop("Cookie", None)
            headers["Authorization"] = self.digest(response.header("www-authenticate"), method, path)
            response = self.send(method, path, body, headers)
        elif response.status == 401 and login and "Authorization" not in headers:  # its session has ended
            headers.pop("Cookie", None)
            response = self.send(method, path, body, {**headers, "Authorization": self.basic()})
        self.cookies.update(response.cookies())
        return response

    def send(self, method, path, body=None, headers=None):
        """Sends as it is, over the same connection as long as that lives."""
        if isinstance(body, str):
            body = body.encode()
        is_new = self.connection is None
        if is_new:
            self.connect()
        try:
            return self._send(method, path, body, headers or {})
        except (http.client.RemoteDisconnected, ConnectionResetError, BrokenPipeError):
            if is_new:
                raise
            self.disconnect()  # the server has closed an idle connection
            self.connect()
            return self._send(method, path, body, headers or {})

    def _send(self, method, path, body, headers):
        self.connection.request(method, path, body=body, headers=headers)
        answer = self.connection.getresponse()
        data = answer.read()
        if answer.will_close:
            self.disconnect()
        return Response(answer.status, answer.getheaders(), data)

    def connect(self):
        if self.dialect == 1:
            self.connection = http.client.HTTPConnection(self.host, self.port, timeout=TIMEOUT)
        else:
            self.connection = http.client.HTTPSConnection(self.host, self.port, timeout=TIMEOUT, context=unchecked_context())

    def disconnect(self):
        if self.connection is not None:
            self.connection.close()
        self.connection = None

    def close(self):
        """Logs off."""
        try:
            if self.cookies:
                self.request("GET", "/logout", login=False)
        except OSError:
            pass
        self.cookies = {}
        self.disconnect()

    # ---- Log on ------------------------------------------------------------------------------------------------------

    def basic(self):
        return "Basic " + base64.b64encode(f"{self.user}:{self.password}".encode()).decode()

    def digest(self, challenge, method, uri, counter=1, qop=True):
        """The answer to a challenge of Digest (RFC 2617; without qop: RFC 2069)."""
        fields = {name: quoted or plain for name, quoted, plain in re.findall(r'(\w+)=(?:"([^"]*)"|([^,\s]*))', challenge)}
        realm, nonce = fields["realm"], fields["nonce"]
        secret = md5(f"{self.user}:{realm}:{self.password}")
        operation = md5(f"{method}:{uri}")
        answer = f'Digest username="{self.user}", realm="{realm}", nonce="{nonce}", uri="{uri}"'
        if not qop:
            return f'{answer}, response="{md5(f"{secret}:{nonce}:{operation}")}"'
        count, own = f"{counter:08x}", os.urandom(8).hex()
        response = md5(f"{secret}:{nonce}:{count}:{own}:auth:{operation}")
        return f'{answer}, response="{response}", qop=auth, nc={count}, cnonce="{own}", algorithm=MD5'

    # ---- Subscriptions -----------------------------------------------------------------------------------------------

    def subscribe(self, *resources):
        """Resources are paths or pairs of path and priority."""
        pairs = [resource if isinstance(resource, tuple) else (resource, 1) for resource in resources]
        fields = []
        for number, (path, priority) in enumerate(pairs, 1):
            fields += [("resources", str(number)), (str(number), path), (f"{number}-p", str(priority))]
        return self.post("/subscription", fields)

    def open_events(self, response, protocol=None, headers=None, path=None):
        """The event socket that a response of subscribe() names."""
        path = path or urllib.parse.urlsplit(response.header("location")).path
        all_headers = {"Cookie": "; ".join(f"{name}={value}" for name, value in self.cookies.items())}
        all_headers.update(headers or {})
        own = "robapi2_subscription" if self.dialect == 1 else "rws_subscription"
        return SocketClient(self.port, path, protocol or own, all_headers, secure=self.dialect == 2)


def md5(text):
    return hashlib.md5(text.encode()).hexdigest()


class RawClient:
    """Bytes as they are: for what no client library sends."""

    def __init__(self, port, secure=False):
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=TIMEOUT)
        if secure:
            self.socket = unchecked_context().wrap_socket(self.socket)
        self.rest = b""

    def send(self, data):
        self.socket.sendall(data.encode() if isinstance(data, str) else data)
        return self

    def read(self, is_head=False):
        """One response; None when the connection has ended."""
        while b"\r\n\r\n" not in self.rest:
            try:
                data = self.socket.recv(65536)
            except ConnectionError:
                data = b""
            if not data:
                return None
            self.rest += data
        head, self.rest = self.rest.split(b"\r\n\r\n", 1)
        lines = head.decode("latin-1").split("\r\n")
        headers = [tuple(part.strip() for part in line.split(":", 1)) for line in lines[1:]]
        response = Response(int(lines[0].split()[1]), headers, b"")
        length = 0 if is_head else int(response.header("content-length") or 0)
        while len(self.rest) < length:
            data = self.socket.recv(65536)
            if not data:
                break
            self.rest += data
        response.body, self.rest = self.rest[:length], self.rest[length:]
        return response

    def has_ended(self, seconds=5):
        """Whether the server closes the connection within that time."""
        self.socket.settimeout(seconds)
        try:
            while True:
                data = self.socket.recv(65536)
                if not data:
                    return True
        except (ConnectionError, ssl.SSLError):
            return True
        except TimeoutError:
            return False

    def close(self):
        self.socket.close()


class SocketClient:
    """A WebSocket (RFC 6455). `status` is that of the response to the upgrade: 101 when it is open."""

    def __init__(self, port, path, protocol, headers, secure=False):
        self.raw = RawClient(port, secure)
        key = base64.b64encode(os.urandom(16)).decode()
        lines = [f"GET {path} HTTP/1.1", f"Host: 127.0.0.1:{port}", "Upgrade: websocket", "Connection: Upgrade",
                 f"Sec-WebSocket-Key: {key}", "Sec-WebSocket-Version: 13"]
        if protocol:
            lines.append(f"Sec-WebSocket-Protocol: {protocol}")
        lines += [f"{name}: {value}" for name, value in headers.items()]
        self.raw.send("\r\n".join(lines) + "\r\n\r\n")
        response = self.raw.read()
        self.status = response.status if response else 0
        self.protocol = response.header("sec-websocket-protocol") if response else None
        if self.status == 101:
            digest = hashlib.sha1((key + "258EAFA5-E914-47DA-95CA-C5AB0DC85B11").encode()).digest()
            if response.header("sec-websocket-accept") != base64.b64encode(digest).decode():
                raise AssertionError("Sec-WebSocket-Accept is wrong")
        self.close_code = None  # of the server
        self.pings = 0

    def send_frame(self, opcode, data=b"", fin=True, mask=True):
        data = data.encode() if isinstance(data, str) else data
        head = bytes([(0x80 if fin else 0) | opcode])
        size = len(data)
        bit = 0x80 if mask else 0
        if size < 126:
            head += bytes([bit | size])
        elif size < 65536:
            head += bytes([bit | 126]) + struct.pack("!H", size)
        else:
            head += bytes([bit | 127]) + struct.pack("!Q", size)
        if mask:
            key = os.urandom(4)
            head += key
            data = bytes(byte ^ key[i % 4] for i, byte in enumerate(data))
        self.raw.send(head + data)

    def _need(self, count, end):
        while len(self.raw.rest) < count:
            self.raw.socket.settimeout(max(0.001, end - time.monotonic()))
            try:
                data = self.raw.socket.recv(65536)
            except ConnectionError:
                data = b""
            if not data:
                return False
            self.raw.rest += data
        return True

    def frame(self, seconds=10):
        """The next frame: (opcode, bytes). None: the connection has ended. Raises TimeoutError."""
        end = time.monotonic() + seconds
        if not self._need(2, end):
            return None
        opcode, size, head = self.raw.rest[0] & 15, self.raw.rest[1] & 127, 2
        if size >= 126:
            head = 4 if size == 126 else 10
            if not self._need(head, end):
                return None
            size = int.from_bytes(self.raw.rest[2:head], "big")
        if not self._need(head + size, end):
            return None
        data, self.raw.rest = self.raw.rest[head:head + size], self.raw.rest[head + size:]
        return opcode, data

    def text(self, seconds=10):
        """The next text; pings are answered. None: the socket has been closed (close_code). Raises TimeoutError."""
        end = time.monotonic() + seconds
        while True:
            frame = self.frame(max(0.001, end - time.monotonic()))
            if frame is None:
                return None
            opcode, data = frame
            if opcode == 1:
                return data.decode()
            if opcode == 9:
                self.pings += 1
                self.send_frame(10, data)
            if opcode == 8:
                self.close_code = int.from_bytes(data[:2], "big") if data else 1005
                return None

    def event(self, seconds=10):
        """The entry of the next event."""
        text = self.text(seconds)
        if text is None:
            raise AssertionError(f"the socket has ended ({self.close_code})")
        if len(text.encode()) >= 1024:
            raise AssertionError(f"an event of {len(text.encode())} bytes")
        kind, entries, _, _ = read_xhtml(text)
        if kind != "state" or len(entries) != 1:
            raise AssertionError(f"not one event: {text}")
        return entries[0]

    def events_within(self, seconds):
        """All events that come in that time."""
        events, end = [], time.monotonic() + seconds
        try:
            while time.monotonic() < end:
                events.append(self.event(max(0.001, end - time.monotonic())))
        except TimeoutError:
            pass
        return events

    def close(self):
        self.raw.close()
