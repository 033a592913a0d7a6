"""The documented path of `robosmi.model.generator.codegen`."""

from robosmi.model.generator.codegen import (
    MIXINS as MIXINS,
)
from robosmi.model.generator.codegen import (
    PackageGenerator as PackageGenerator,
)
from robosmi.model.generator.codegen import (
    PackageRun as PackageRun,
)
from robosmi.model.generator.codegen import (
    PackageTask as PackageTask,
)
from robosmi.model.generator.codegen import (
    Rendered as Rendered,
)
from robosmi.model.generator.codegen import (
    generate_built_in as generate_built_in,
)
from robosmi.model.generator.codegen import (
    problems_of as problems_of,
)
from robosmi.model.generator.codegen import (
    render as render,
)
