"""`crustline certify`: whether the theory guarantees the curves through points, and where not."""

from __future__ import annotations

import json

import click

from crustline.cli.method import Method, method_options
from crustline.cli.output import Output, output_options
from crustline.cli.reconstruct import reconstruction
from crustline.cli.sections import Sectioned
from crustline.cli.source import Source, source_options


@click.command(cls=Sectioned)
@source_options
@output_options("write_points")
@click.option("--strict", is_flag=True,
              help="Exit with code 1 if the curves are not guaranteed.")  # fmt: skip
@method_options
def certify(source: Source, output: Output, strict: bool, method: Method) -> None:
    """Say whether the theory guarantees the curves.

    INPUT is a file of points; - is standard input. Prints what is proven, what is estimated, and
    what breaks the guarantee. With -o it writes the points that break it: their row in the input,
    the reason, and what they carry. There more samples are needed.

    \b
        crustline certify goose.csv -o more_samples_here.csv
    """
    with reconstruction(source, method, output.quiet) as made:
        certificate = made.certificate
    output.write(certificate)
    if output.as_json:
        about = {"input": source.name, "method": method.name, "outputs": list(output.files)}
        text = json.dumps(about | certificate.to_dict(), allow_nan=False)
    else:
        text = certificate.summary()
    if output.as_json or not output.quiet:
        click.echo(text, err="-" in output.files)
    if strict and not certificate.guaranteed:
        raise click.exceptions.Exit(1)
