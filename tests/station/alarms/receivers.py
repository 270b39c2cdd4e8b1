"""Receivers of alerts on this machine: a mail server and a web server that note what comes."""

import errno
import ssl
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import UTC, datetime, timedelta
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from threading import Thread
from typing import Any, NamedTuple

from aiosmtpd.controller import Controller
from aiosmtpd.smtp import AuthResult, LoginPassword
from cryptography import x509
from cryptography.hazmat.primitives import hashes, serialization
from cryptography.hazmat.primitives.asymmetric import ec
from cryptography.x509.oid import NameOID

from tests.support.ports import free_port
from tests.support.waiting import WITHIN


class Certificate(NamedTuple):
    """Of `localhost`, signed by itself."""

    certificate: Path
    key: Path

    def server(self) -> ssl.SSLContext:
        context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
        context.load_cert_chain(self.certificate, self.key)
        return context


def certificate_in(folder: Path) -> Certificate:
    key = ec.generate_private_key(ec.SECP256R1())
    name = x509.Name([x509.NameAttribute(NameOID.COMMON_NAME, "localhost")])
    begin = datetime.now(UTC) - timedelta(days=1)
    made = (
        x509.CertificateBuilder()
        .subject_name(name).issuer_name(name).public_key(key.public_key()).serial_number(x509.random_serial_number())
        .not_valid_before(begin).not_valid_after(begin + timedelta(days=30))
        .add_extension(x509.SubjectAlternativeName([x509.DNSName("localhost")]), critical=False)
        .add_extension(x509.BasicConstraints(ca=True, path_length=None), critical=True)
        .sign(key, hashes.SHA256())
    )  # fmt: skip
    files = Certificate(folder / "certificate.pem", folder / "key.pem")
    files.certificate.write_bytes(made.public_bytes(serialization.Encoding.PEM))
    files.key.write_bytes(
        key.private_bytes(
            serialization.Encoding.PEM, serialization.PrivateFormat.PKCS8, serialization.NoEncryption()
        )
    )  # fmt: skip
    return files


class MailReceiver:
    """Notes each mail; answers `refusals` of them with 451 first."""

    def __init__(self, refusals: int = 0) -> None:
        self.mails: list[bytes] = []
        self.users: list[str] = []
        self.tls: list[bool] = []
        self.refusals = refusals
        self.unknown: set[str] = set()
        """Addresses that it does not take."""

    async def handle_RCPT(self, server: Any, session: Any, envelope: Any, address: str, options: Any) -> str:
        if address in self.unknown:
            return "550 nobody of that name"
        envelope.rcpt_tos.append(address)
        return "250 thank you"

    async def handle_DATA(self, server: Any, session: Any, envelope: Any) -> str:
        if self.refusals:
            self.refusals -= 1
            return "451 the disk is full"
        self.mails.append(envelope.content)
        self.tls.append(session.ssl is not None)
        return "250 thank you"

    def login(self, server: Any, session: Any, envelope: Any, mechanism: str, data: Any) -> AuthResult:
        right = isinstance(data, LoginPassword) and data.password == b"secret word"
        if right:
            self.users.append(data.login.decode())
        return AuthResult(success=right)


@contextmanager
def mail_server(receiver: MailReceiver, **options: Any) -> Iterator[int]:
    """A mail server on a free port."""
    controller = _started(receiver, options)
    try:
        yield controller.port
    finally:
        controller.stop()


def _started(receiver: MailReceiver, options: dict[str, Any]) -> Controller:
    """Its controller wants to know the port before; another program may take that meanwhile."""
    for _ in range(10):
        controller = Controller(receiver, hostname="localhost", port=free_port(), ready_timeout=WITHIN, **options)
        try:
            controller.start()
        except OSError as error:
            if error.errno != errno.EADDRINUSE:
                raise
        else:
            return controller
    raise RuntimeError("no port is free")


class WebReceiver(BaseHTTPRequestHandler):
    """Notes each request and answers as told."""

    server: Any

    def do_POST(self) -> None:
        body = self.rfile.read(int(self.headers.get("Content-Length", 0)))
        self.server.requests.append((self.path, dict(self.headers), body))
        status = self.server.answers.pop(0) if self.server.answers else 200
        self.send_response(status)
        if 300 <= status < 400:
            self.send_header("Location", f"http://127.0.0.1:{self.server.server_port}/elsewhere")
        self.end_headers()

    do_GET = do_POST

    def log_message(self, *_: Any) -> None:
        """Keep still."""


@contextmanager
def web_server(*answers: int, context: ssl.SSLContext | None = None) -> Iterator[Any]:
    """A web server on a free port; `requests` is what came."""
    server: Any = ThreadingHTTPServer(("127.0.0.1", 0), WebReceiver)
    server.requests, server.answers = [], list(answers)
    if context is not None:
        server.socket = context.wrap_socket(server.socket, server_side=True)
    thread = Thread(target=server.serve_forever, args=(0.05,), daemon=True)
    thread.start()
    try:
        yield server
    finally:
        server.shutdown()
        server.server_close()
        thread.join()
