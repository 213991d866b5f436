"""Names of coordinate reference systems, as the formats spell them. Nothing is transformed."""

from __future__ import annotations

import re

# RFC 7946 knows longitude and latitude on WGS 84 only, so GeoJSON leaves their name away.
_LONGITUDE_LATITUDE = ("EPSG:4326", "OGC:CRS84")


def normalize_crs(name: str) -> str:
    """Return a CRS as "EPSG:25832" where it is an EPSG code in any spelling, else as it is.

    >>> normalize_crs("urn:ogc:def:crs:EPSG::25832"), normalize_crs("epsg:4326")
    ('EPSG:25832', 'EPSG:4326')
    """
    name = name.strip()
    match = re.fullmatch(r"(?:urn:ogc:def:crs:)?EPSG:(?:[\w.]*:)?(\d+)", name, re.IGNORECASE)
    if match:
        return f"EPSG:{match[1]}"
    return "OGC:CRS84" if re.fullmatch(r".*\bCRS84", name, re.IGNORECASE) else name


def epsg_code(crs: str | None) -> int | None:
    """Return the number of an EPSG code, or None for any other CRS."""
    match = re.fullmatch(r"EPSG:(\d+)", crs or "", re.IGNORECASE)
    return int(match[1]) if match else None


def geojson_member(crs: str | None) -> dict[str, object] | None:
    """Return the "crs" member for a GeoJSON file, or None where RFC 7946 implies it."""
    if crs is None or crs in _LONGITUDE_LATITUDE:
        return None
    code = epsg_code(crs)
    name = crs if code is None else f"urn:ogc:def:crs:EPSG::{code}"
    return {"type": "name", "properties": {"name": name}}
