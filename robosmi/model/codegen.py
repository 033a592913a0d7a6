"""The documented path of `robosmi.model.generator.codegen`."""

from robosmi.model.generator.codegen import (
    MIXINS as MIXINS,
    PackageGenerator as PackageGenerator,
    PackageRun as PackageRun,
    PackageTask as PackageTask,
    Rendered as Rendered,
    generate_built_in as generate_built_in,
    problems_of as problems_of,
    render as render,
)
