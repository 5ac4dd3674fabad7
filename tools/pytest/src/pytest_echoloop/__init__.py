"""A sonar for your driver's tests: the pytest fixture `echoloop`. The README says how to use it."""

from .program import EcholoopError
from .sonar import Message, Sonar

__all__ = ["EcholoopError", "Message", "Sonar"]
