"""Serves a station on a port until somebody ends it."""

import errno
import logging
import signal
import socket
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace

import uvicorn
from fastapi import FastAPI

from stommel.station.web.exposure import Exposure, ExposureError

GRACE = 1
"""Seconds for answers that are under way at the end."""
MOST_CONNECTIONS = 1000
_LARGEST_MESSAGE = 65_536
_ENDS = (signal.SIGINT, signal.SIGTERM)


def listening(exposure: Exposure) -> tuple[socket.socket, Exposure]:
    """Take the port; returns it with the exposure as it is, the port of which is known.

    Raises
    ------
    ExposureError
        The port is in use, or the host is none of this machine.
    """
    host, port = exposure.host.strip("[]"), exposure.port
    try:
        family, kind, protocol, _, address = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)[0]
        taken = socket.socket(family, kind, protocol)
        try:
            taken.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            taken.bind(address)
            taken.listen(256)
        except BaseException:
            taken.close()
            raise
    except OSError as error:
        raise ExposureError(_why_not(host, port, error)) from None
    return taken, replace(exposure, port=taken.getsockname()[1])


def serve(app: FastAPI, exposure: Exposure, taken: socket.socket, ready: Callable[[], None]) -> None:
    """Serve until Ctrl-C or SIGTERM; `ready` is called when a browser may come."""
    config = uvicorn.Config(
        app,
        log_config=None,
        log_level=logging.WARNING,
        access_log=False,
        lifespan="off",
        loop="asyncio",
        http="h11",
        ws="websockets-sansio",
        ws_max_size=_LARGEST_MESSAGE,
        server_header=False,
        proxy_headers=exposure.behind_proxy,
        forwarded_allow_ips=list(exposure.proxies),
        limit_concurrency=MOST_CONNECTIONS,
        timeout_graceful_shutdown=GRACE,
        ssl_certfile=exposure.certificate,
        ssl_keyfile=exposure.key_file,
    )
    server = _Server(config)
    with _told_when_ready(server, ready):
        server.run([taken])


class _Server(uvicorn.Server):
    """Ends when asked and gives back what it holds, instead of raising the signal anew."""

    @contextmanager
    def capture_signals(self) -> Iterator[None]:
        if threading.current_thread() is not threading.main_thread():
            yield
            return
        before = {number: signal.signal(number, self.handle_exit) for number in _ENDS}
        try:
            yield
        finally:
            for number, handler in before.items():
                signal.signal(number, handler)


@contextmanager
def _told_when_ready(server: uvicorn.Server, ready: Callable[[], None]) -> Iterator[None]:
    """Call `ready` once the server has started."""
    ended = threading.Event()

    def wait() -> None:
        while not ended.wait(0.01):
            if server.started:
                ready()
                return

    watcher = threading.Thread(target=wait, daemon=True)
    watcher.start()
    try:
        yield
    finally:
        ended.set()
        watcher.join()


def _why_not(host: str, port: int, error: OSError) -> str:
    if error.errno == errno.EADDRINUSE:
        return f"--port {port}: another program uses port {port} of {host}; end it, or give another --port (0: any)"
    if error.errno == errno.EACCES:
        return f"--port {port}: only the administrator of this machine may use it; give one from 1024 to 65535"
    if isinstance(error, socket.gaierror) or error.errno == errno.EADDRNOTAVAIL:
        return f"--host {host}: is no address of this machine; give 127.0.0.1, or the address of one of its networks"
    return f"--host {host} --port {port}: cannot be served: {error.strerror or error}"
