"""Is this a certificate? Refused with the field that is missing or of another type."""

from __future__ import annotations

from typing import Any

from raycert.oracle.certify.certificate import CERTIFICATE_VERSION

Json = dict[str, Any]
FIELDS: dict[str, type | tuple[type, ...]] = {
    "granted": bool,
    "passed": bool,
    "accepted": bool,
    "standing": dict,
    "reasons": list,
    "asked": dict,
    "selection": list,
    "shard": (str, type(None)),
    "subject": dict,
    "corpus": dict,
    "tool": dict,
    "environment": dict,
    "run": dict,
    "tested": int,
    "not_tested": dict,
    "not_decisive": dict,
    "solids": dict,
    "families": list,
    "table": dict,
    "worst": list,
    "expectations": (dict, type(None)),
    "failures": list,
    "reproduce": str,
}


class BadCertificate(ValueError):
    """What is read is no certificate; the text names the field."""


def check(form: object) -> Json:
    """Return a certificate as it is, or refuse it. The whole form is for the JSON Schema."""
    if not isinstance(form, dict) or "certificate" not in form:
        raise BadCertificate("certificate: is missing; is this a file that certify wrote?")
    if form["certificate"] != CERTIFICATE_VERSION:
        raise BadCertificate(f"certificate: is not version {CERTIFICATE_VERSION}")
    for name, kind in FIELDS.items():
        if name not in form:
            raise BadCertificate(f"{name}: is missing")
        if not isinstance(form[name], kind):
            raise BadCertificate(f"{name}: is of another type")
    return form
