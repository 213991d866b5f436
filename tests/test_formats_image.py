"""Pictures in files: each kind, its place in the world, and what is wrong with them."""

from __future__ import annotations

import io
import struct
import warnings
import zlib
from pathlib import Path

import numpy as np
import pytest
import rasterio
from PIL import Image
from rasterio.control import GroundControlPoint
from rasterio.transform import Affine

import crustline as cl
from crustline.cli import main
from crustline.formats import FORMATS
from pictures import disk, far_from_circle, painted, ring

CIRCLE = (61.3, 66.7, 40.2)
GRAY = np.round(255 * disk(128, *CIRCLE)).astype(np.uint8)
# A turned, stretched place in the world: x and y of (column, row).
PLACE = Affine(0.5, 0.1, 400_000.0, 0.1, -0.5, 5_000_000.0)


def packed(image, kind: str, **options) -> bytes:
    stream = io.BytesIO()
    (image if isinstance(image, Image.Image) else Image.fromarray(image)).save(
        stream, kind, **options
    )
    return stream.getvalue()


def geotiff(path: Path, bands, **profile) -> Path:
    bands = bands if bands.ndim == 3 else bands[None]
    count, height, width = bands.shape
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        with rasterio.open(
            path, "w", "GTiff", width, height, count, dtype=bands.dtype, **profile
        ) as data:
            data.write(bands)
    return path


def assert_is_circle(points: cl.Points, most: float = 0.1) -> None:
    assert np.abs(far_from_circle(points.xy, *CIRCLE)).max() < most
    assert len(points) > 200


def refusal(source, **options) -> str:
    with pytest.raises(cl.CrustlineError) as caught:
        cl.read(source, **options)
    assert "\n" not in str(caught.value)
    return str(caught.value)


# Kinds


@pytest.mark.parametrize(
    "content",
    [
        packed(GRAY, "PNG"),
        packed(GRAY, "GIF"),
        packed(GRAY, "BMP"),
        packed(GRAY, "PPM"),
        packed(GRAY, "TIFF"),
        packed(GRAY, "WEBP", lossless=True),
        packed(GRAY.astype(np.uint16) * 257, "PNG"),
        packed(Image.fromarray(GRAY).convert("P"), "PNG"),
        packed(Image.fromarray(GRAY).convert("LA"), "PNG"),
        packed(Image.fromarray(GRAY).convert("RGBA"), "PNG"),
        packed(Image.fromarray(GRAY).convert("CMYK"), "JPEG", quality=100),
        packed(Image.fromarray(GRAY / np.float32(255)), "TIFF"),
        packed(painted(GRAY / 255, (255, 0, 0), (0, 0, 255)), "PNG"),
    ],
)
def test_every_kind_of_picture_is_read(content):
    assert_is_circle(cl.read(content), 0.12)


@pytest.mark.parametrize("kind", ["PNG", "TIFF"])
def test_a_picture_of_one_bit_is_read(kind):
    assert_is_circle(cl.read(packed(Image.fromarray(GRAY > 127), kind)), 0.5)


def test_a_photograph_is_turned_as_its_camera_says():
    exif = Image.Exif()
    exif[0x0112] = 6  # to be turned clockwise to be seen
    turned = np.rot90(GRAY)
    content = packed(Image.fromarray(turned), "PNG", exif=exif.tobytes())
    assert_is_circle(cl.read(content))


def test_one_of_many_bands_is_read(tmp_path):
    bands = np.stack([np.zeros_like(GRAY), GRAY, *np.zeros((5, 128, 128), np.uint8)])
    path = geotiff(tmp_path / "bands.tif", bands)
    assert "it has 7 bands" in refusal(path)
    assert "choose one (--band 1)" in refusal(path)
    assert_is_circle(cl.read(path, band=2))
    assert "no band 8: choose from 1 to 7" in refusal(path, band=8)


def test_mask_color_and_lines():
    assert_is_circle(cl.read(packed(GRAY, "PNG"), mask=True), 0.12)
    red = packed(painted(GRAY / 255, (221, 0, 0), (255, 255, 255)), "PNG")
    assert_is_circle(cl.read(red, color="#d00"), 0.15)
    stroke = packed(painted(ring(128, *CIRCLE, 3), (221, 0, 0), (255, 255, 255)), "PNG")
    assert_is_circle(cl.read(stroke, lines=True), 0.15)
    assert_is_circle(cl.read(stroke, lines=True, color=(221, 0, 0)), 0.15)


def test_a_palette_and_values_without_data(tmp_path):
    flat = (GRAY > 127).astype(np.uint8)
    path = geotiff(tmp_path / "palette.tif", flat)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        with rasterio.open(path, "r+") as data:
            data.write_colormap(1, {0: (255, 255, 255, 255), 1: (221, 0, 0, 255)})
    assert_is_circle(cl.read(path, color="#d00"), 0.6)
    heights = np.where(flat, np.float32(120.5), np.float32(-9999))
    path = geotiff(tmp_path / "heights.tif", heights, nodata=-9999)
    assert_is_circle(cl.read(path, mask=True), 0.6)


def chunked(*chunks: tuple[bytes, bytes]) -> bytes:
    """A PNG as another program would put it together."""
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        for kind, data in chunks
    )


FLAT = (GRAY > 127).astype(np.uint8)
ROWS = b"".join(b"\0" + row.tobytes() for row in GRAY)
HEADER = struct.pack(">IIBBBBB", 128, 128, 8, 0, 0, 0, 0)
FOREIGN = {
    "many IDAT chunks and a text": chunked(
        (b"IHDR", HEADER), (b"tEXt", b"Comment\0by hand"),
        *((b"IDAT", part) for part in (zlib.compress(ROWS)[:50], zlib.compress(ROWS)[50:])),
        (b"IEND", b""),
    ),
    "bytes after the end": packed(GRAY, "PNG") + b"trailing",
    "progressive JPEG": packed(GRAY, "JPEG", quality=95, progressive=True),
    "JPEG with a comment": packed(GRAY, "JPEG", quality=95, comment=b"x" * 9000),
    "text PGM with comments": b"P2 # c\n128 128\n# max\n255\n" + b"\n".join(
        " ".join(map(str, row)).encode() for row in GRAY.tolist()
    ),
    "PBM": b"P4\n128 128\n" + np.packbits(1 - FLAT, axis=1).tobytes(),
    "animated GIF": packed(GRAY, "GIF", save_all=True, append_images=[Image.new("L", (128, 128))]),
    "TIFF with JPEG in it": packed(GRAY, "TIFF", compression="jpeg", quality=95),
    "TIFF of one bit by CCITT": packed(
        Image.fromarray(GRAY > 127), "TIFF", compression="group4"
    ),
    "big-endian TIFF": b"MM\0*" + struct.pack(">I", 8) + struct.pack(">H", 8) + b"".join(
        struct.pack(">HHI", tag, kind, 1) + value
        for tag, kind, value in (
            (256, 4, struct.pack(">I", 128)), (257, 4, struct.pack(">I", 128)),
            (258, 3, struct.pack(">HH", 8, 0)), (259, 3, struct.pack(">HH", 1, 0)),
            (262, 3, struct.pack(">HH", 1, 0)), (273, 4, struct.pack(">I", 110)),
            (278, 4, struct.pack(">I", 128)), (279, 4, struct.pack(">I", 128 * 128)),
        )
    ) + bytes(4) + GRAY.tobytes(),
    "BMP of a palette": packed(Image.fromarray(GRAY).convert("P"), "BMP"),
}  # fmt: skip


@pytest.mark.parametrize("name", FOREIGN)
def test_a_foreign_picture_is_read(name):
    assert_is_circle(cl.read(FOREIGN[name]), 0.6)


# Places


def assert_in_the_world(points: cl.Points, crs: str | None) -> None:
    columns, rows = ~PLACE @ points.xy.T
    assert_is_circle(cl.Points(np.column_stack([columns, -np.asarray(rows)])))
    assert points.crs == crs


def test_geotransform_and_crs_of_a_geotiff_are_kept(tmp_path):
    path = geotiff(tmp_path / "a.tif", GRAY, transform=PLACE, crs="EPSG:25832")
    assert_in_the_world(cl.read(path), "EPSG:25832")
    assert_in_the_world(cl.read(path.read_bytes()), "EPSG:25832")
    assert_is_circle(cl.read(path, pixels=True))
    assert cl.read(path, pixels=True).crs is None


@pytest.mark.parametrize("suffix", [".pgw", ".PGW", ".pngw", ".wld"])
def test_a_world_file_beside_is_heard(tmp_path, suffix):
    path = tmp_path / "a.png"
    path.write_bytes(packed(GRAY, "PNG"))
    x, y = PLACE @ (0.5, 0.5)
    numbers = [PLACE.a, PLACE.d, PLACE.b, PLACE.e, x, y]
    path.with_suffix(suffix).write_text("\r\n".join(map(repr, map(float, numbers))))
    assert_in_the_world(cl.read(path), None)
    assert_in_the_world(cl.read(path, crs="EPSG:25832"), "EPSG:25832")
    path.with_suffix(".prj").write_text("EPSG:25832")
    assert_in_the_world(cl.read(path), "EPSG:25832")
    assert_is_circle(cl.read(path, pixels=True))


def test_a_world_file_beside_a_tiff_is_heard(tmp_path):
    path = geotiff(tmp_path / "a.tif", GRAY)
    x, y = PLACE @ (0.5, 0.5)
    numbers = [PLACE.a, PLACE.d, PLACE.b, PLACE.e, x, y]
    path.with_suffix(".tfw").write_text("\n".join(map(repr, map(float, numbers))))
    assert_in_the_world(cl.read(path), None)


def test_a_sidecar_of_gdal_is_heard(tmp_path):
    path = tmp_path / "a.png"
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        profile = {"transform": PLACE, "crs": "EPSG:25832", "dtype": np.uint8}
        with rasterio.open(path, "w", "PNG", 128, 128, 1, **profile) as data:
            data.write(GRAY, 1)
    assert path.with_name("a.png.aux.xml").exists()
    assert_in_the_world(cl.read(path), "EPSG:25832")


def test_axes_give_data_coordinates():
    text = "0,127=0,1 127,0=10,1000 log=y"
    points = cl.read(packed(GRAY, "PNG"), axes=text)
    columns = points.xy[:, 0] / 10 * 127 + 0.5
    rows = 127.5 - np.log10(points.xy[:, 1]) / 3 * 127
    assert_is_circle(cl.Points(np.column_stack([columns, -rows])))


# What is wrong


def png_of_size(width: int, height: int) -> bytes:
    header = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    return chunked((b"IHDR", header), (b"IDAT", zlib.compress(bytes(1000))), (b"IEND", b""))


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (png_of_size(40_000, 25_000), "more than 67,108,864 pixels: cut out"),
        (png_of_size(2**31 - 1, 2**31 - 1), "pixel"),
        (png_of_size(300, 200), "cannot read it"),
        (packed(GRAY, "PNG")[:300], "cannot read it"),
        (packed(GRAY, "JPEG")[:600], "cannot read it"),
        (packed(GRAY, "TIFF")[:300], "cannot read it"),
        (packed(GRAY, "GIF")[:20], "it begins as GIF and is damaged"),
        (packed(GRAY, "JPEG")[:30], "cannot read it"),
        (packed(GRAY, "WEBP")[:20], "cannot read it"),
        (packed(np.zeros((9, 9), np.uint8), "PNG"), "no edge is found in it: look for weaker ones"),
    ],
)
def test_bad_pictures_are_refused_in_a_sentence(content, words):
    assert words in refusal(content)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"mask": True, "color": "#d00"}, "--mask goes with neither --color nor --lines"),
        ({"lines": True, "contrast": 0.1}, "--contrast is for edges"),
        ({"lines": True, "blur": 1}, "--blur is not for --lines"),
        ({"color": "red"}, "write it as '#d00'"),
        ({"color": "#0a0"}, "no boundary is found in it"),
        ({"color": "#0a0", "lines": True}, "no stroke is found in it"),
        ({"axes": "1"}, "give places as COLUMN,ROW=X,Y"),
        ({"axes": 1}, "give text"),
        ({"band": 0}, "at least 1"),
        ({"band": 3}, "it has one band, and no band 3"),
        ({"contrast": 2}, "give a number in (0, 1]"),
        ({"blur": 0}, "give a number above 0"),
        ({"layer": "a"}, "no option 'layer'"),
    ],
)
def test_bad_options_are_refused_in_a_sentence(options, words):
    assert words in refusal(packed(GRAY, "PNG"), **options)


def test_a_geotiff_of_a_billion_pixels_is_refused_before_it_is_read(tmp_path):
    path = tmp_path / "large.tif"
    with rasterio.open(
        path, "w", "GTiff", 40_000, 25_000, 1, dtype=np.uint8, transform=PLACE, SPARSE_OK=True
    ):
        pass
    assert path.stat().st_size < 3_000_000
    assert "more than 67,108,864 pixels" in refusal(path)


def test_a_geotiff_with_a_crs_and_no_transform_is_refused(tmp_path):
    path = geotiff(tmp_path / "a.tif", GRAY, crs="EPSG:25832")
    assert "it has a CRS (EPSG:25832) and no geotransform" in refusal(path)
    assert_is_circle(cl.read(path, pixels=True))


def test_a_geotiff_with_control_points_alone_is_refused(tmp_path):
    gcps = [
        GroundControlPoint(row, column, 10.0 + column, 50.0 - row)
        for row, column in ((0, 0), (0, 128), (128, 0), (128, 128))
    ]
    path = geotiff(tmp_path / "a.tif", GRAY, gcps=gcps, crs="EPSG:4326")
    assert "ground control points alone" in refusal(path)
    assert_is_circle(cl.read(path, pixels=True))


@pytest.mark.parametrize("text", ["", "1 2 3", "1 0 0 x 0 0", "1 0 0 nan 0 0", "0 0 0 0 0 0"])
def test_a_bad_world_file_is_refused(tmp_path, text):
    path = tmp_path / "a.png"
    path.write_bytes(packed(GRAY, "PNG"))
    path.with_suffix(".pgw").write_text(text)
    assert "--pixels" in refusal(path)
    assert_is_circle(cl.read(path, pixels=True))


def test_without_the_extra_it_says_what_to_install(monkeypatch):
    monkeypatch.setattr("crustline.errors.find_spec", lambda name: None)
    assert "crustline[image]" in refusal(packed(GRAY, "PNG"))


# The command


def test_the_command_traces_a_picture(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    Path("photo.png").write_bytes(packed(GRAY, "PNG"))
    with pytest.raises(SystemExit) as caught:
        main(["reconstruct", "photo.png", "-o", "outline.geojson", "--contrast", "0.3"])
    assert caught.value.code == 0
    curves = cl.read_curves("outline.geojson")
    assert curves.closed.tolist() == [True]
    assert_is_circle(curves.points)
    capsys.readouterr()


def test_the_command_refuses_in_a_line_and_writes_nothing(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    Path("photo.png").write_bytes(packed(GRAY, "PNG")[:400])
    with pytest.raises(SystemExit) as caught:
        main(["reconstruct", "photo.png", "-o", "outline.svg"])
    assert caught.value.code == 2
    assert capsys.readouterr().err.count("\n") == 1
    assert sorted(path.name for path in tmp_path.iterdir()) == ["photo.png"]


@pytest.mark.parametrize("name", ["photo.png", "photo.tif"])
def test_a_drawing_over_a_picture_fits_pixel_on_pixel(tmp_path, name):
    resvg = pytest.importorskip("resvg_py")
    path = tmp_path / name
    path.write_bytes(packed(GRAY, "PNG"))
    if name.endswith("tif"):
        geotiff(path, GRAY, transform=PLACE, crs="EPSG:25832")
    curves = cl.reconstruct(cl.read(path))
    cl.write(curves, tmp_path / "over.svg", over=path)
    text = (tmp_path / "over.svg").read_text()
    assert 'viewBox="0 0 128 128"' in text
    drawn = bytes(resvg.svg_to_bytes(svg_string=text, width=1280, height=1280))
    image = np.asarray(Image.open(io.BytesIO(drawn)).convert("RGB")).astype(int)
    # The stroke is where the picture changes, and the picture inside and outside of it.
    orange = (image[..., 0] - image[..., 2]) > 100
    rows, columns = np.nonzero(orange)
    far = np.hypot((columns + 0.5) / 10 - CIRCLE[0], (rows + 0.5) / 10 - CIRCLE[1]) - CIRCLE[2]
    assert len(far) > 1000
    assert np.abs(far).max() < 1.3
    assert image[667, 613].min() > 240
    assert image[5, 5].max() < 15


def test_over_what_is_no_picture_is_refused(tmp_path):
    curves = cl.reconstruct([(0, 0), (1, 0), (0, 1)])
    with pytest.raises(cl.FormatError, match="no such file"):
        cl.write(curves, tmp_path / "over.svg", over=str(tmp_path / "missing.png"))
    (tmp_path / "text.png").write_text("x,y")
    with pytest.raises(cl.FormatError, match="no picture that is known"):
        cl.write(curves, tmp_path / "over.svg", over=str(tmp_path / "text.png"))
    assert not (tmp_path / "over.svg").exists()


def test_a_plot_is_joined_in_pixels(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    stroke = 255 - np.round(255 * ring(128, *CIRCLE, 3)).astype(np.uint8)
    Path("plot.png").write_bytes(packed(stroke, "PNG"))
    axes = "0,127=0,1e-6 127,0=1e6,1e6 log=y"
    words = ["reconstruct", "plot.png", "--lines", "--axes", axes, "-o", "curve.geojson"]
    with pytest.raises(SystemExit) as caught:
        main(words)
    assert caught.value.code == 0
    curves = cl.read_curves("curve.geojson")
    assert curves.closed.tolist() == [True]
    assert np.ptp(curves.points.xy[:, 1]) > 1000
    pixels = np.column_stack([curves.points.columns[f"pixel_{axis}"] for axis in "xy"])
    assert_is_circle(cl.Points(pixels), 0.15)
    with pytest.raises(SystemExit) as caught:
        main([*words, "--fit"])
    assert caught.value.code == 2
    assert "--axes and --fit exclude each other" in capsys.readouterr().err


def test_options_are_in_the_table():
    names = {option.spelling for option in FORMATS["image"].options}
    assert names == {
        "--axes", "--band", "--blur", "--color", "--contrast", "--lines", "--mask", "--pixels",
    }  # fmt: skip
