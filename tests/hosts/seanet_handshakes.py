"""The order in which known hosts talk to a SeaNet head until it scans, with the time limits that each has."""

import seanet_wire as wire
from seanet_session import HostConfused, HostTimeout

BOOT_SECONDS = 30.0


def rock(session):
    """Version and BB user block (3 s each), HeadCommand, any willing mtAlive within 10 s; no reboot."""
    session.send(wire.build(wire.SEND_VERSION))
    session.wait(3.0, wire.VERSION_DATA)
    session.send(wire.build(wire.SEND_BB_USER))
    session.wait(3.0, wire.BB_USER_DATA)
    rock_configure(session, 10.0)


def rock_main(session):
    """As Rock's own main program: nothing but HeadCommand, 1 s for the mtAlive."""
    rock_configure(session, 1.0)


def rock_configure(session, seconds=1.0):
    session.configure()
    session.wait_alive(
        seconds, lambda a: a.has(wire.CENTRED) or a.lacks(wire.NO_PARAMS) or a.has(wire.SENT_CFG)
    )


def mcgill(session):
    """Reboots, configures while the head re-centres, needs two alives with HeadInf bit 0 set and bit 1 clear.

    It reads HeadInf in the opposite bit order; bit 0 is its "has configuration", bit 1 its "no parameters".
    """
    session.line.flush_input()
    session.send(wire.build(wire.REBOOT))
    _retry_alive(session)
    session.configure()
    session.wait_alive(BOOT_SECONDS, _mcgill_ready)
    _retry_alive(session)
    if not _mcgill_ready(session.alive):
        raise HostConfused(f"HeadInf {session.alive.head_inf:02X} while bit 0 set and bit 1 clear is needed")


def _mcgill_ready(alive):
    return alive.has(wire.IN_CENTRE) and alive.lacks(wire.CENTRED)


def _retry_alive(session, tries=5):
    for _ in range(tries):
        try:
            return session.wait_alive(2.0)
        except HostTimeout:
            continue
    raise HostTimeout(f"no Alive in {tries} tries of 2 s")


def host_a(session, pause=5.0):
    """ReBoot, Alive, SendVersion each second until answered, HeadCommand if NoParams, a pause, Alive."""
    session.send(wire.build(wire.REBOOT))
    session.wait_alive(BOOT_SECONDS)
    for _ in range(10):
        session.send(wire.build(wire.SEND_VERSION))
        try:
            session.wait(1.0, wire.VERSION_DATA)
            break
        except HostTimeout:
            continue
    else:
        raise HostTimeout("no VersionData to 10 requests")
    if session.wait_alive(BOOT_SECONDS).has(wire.NO_PARAMS):
        session.configure()
    session.pass_time(pause)
    session.wait_alive(BOOT_SECONDS, lambda a: a.lacks(wire.NO_PARAMS))


def host_b(session):
    """DST-aware: alives at most 1.5 s apart, BBUserData of 264 bytes, then 63 and 57 if its byte 19 is 15."""
    session.wait_alive(BOOT_SECONDS)
    session.send(wire.build(wire.REBOOT))
    session.pass_time(1.0)
    session.wait_alive(
        BOOT_SECONDS, lambda a: a.has(wire.CENTRED) and a.lacks(wire.MOTORING, wire.SENT_CFG), gap=1.5
    )
    session.send(wire.build(wire.SEND_VERSION))
    session.wait(4.0, wire.VERSION_DATA)
    session.send(wire.build(wire.SEND_BB_USER))
    block = session.wait(10.0, wire.BB_USER_DATA).raw
    dst = block[19] == 15
    session.tell("bb_user", dst=dst, half_duplex=block[146 if dst else 99] == 1)
    if dst:
        following = [session.wait(10.0, wire.FPGA_CAL_DATA, wire.FPGA_VERSION_DATA).message for _ in range(2)]
        if following != [wire.FPGA_CAL_DATA, wire.FPGA_VERSION_DATA]:
            raise HostConfused(f"messages {following} after BBUserData, not 63 and 57")
    session.wait_alive(10.0, lambda a: a.has(wire.NO_PARAMS, wire.SENT_CFG), gap=1.5)
    session.configure()
    session.wait_alive(10.0, lambda a: a.lacks(wire.NO_PARAMS), gap=1.5)


def host_c(session):
    """MiniKing: the pair 63 and 57 would crash it; HeadCommand again until mtAlive byte 13 is 0."""
    session.wait_alive(BOOT_SECONDS)
    session.send(wire.build(wire.SEND_VERSION))
    session.wait(10.0, wire.VERSION_DATA)
    session.send(wire.build(wire.SEND_BB_USER))
    session.wait(10.0, wire.BB_USER_DATA)
    session.wait_alive(BOOT_SECONDS)
    for unwanted in ("FpgaCalData", "FpgaVersionData"):
        if session.counts.get(unwanted):
            raise HostConfused(f"{unwanted} sent by a head that is not DST")
    for _ in range(60):
        session.configure()
        if session.wait_alive(BOOT_SECONDS).params_byte == 0:
            return
    raise HostTimeout("mtAlive byte 13 never became 0")


def delphin(session):
    """ReBoot, Alive, flush, HeadCommand until an Alive follows within 2 s."""
    session.send(wire.build(wire.REBOOT))
    session.wait_alive(BOOT_SECONDS)
    session.line.flush_input()
    for _ in range(10):
        session.configure()
        try:
            session.wait_alive(2.0)
            return
        except HostTimeout:
            continue
    raise HostTimeout("no Alive to 10 HeadCommands")


HANDSHAKES = {
    "rock": rock,
    "rock-main": rock_main,
    "mcgill": mcgill,
    "hostA": host_a,
    "hostB": host_b,
    "hostC": host_c,
    "delphin": delphin,
}
