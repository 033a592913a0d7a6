"""The documented path of `robosmi.query.any_operations`."""

from robosmi.query.any_operations import (
    as_bag as as_bag,
)
from robosmi.query.any_operations import (
    as_boolean as as_boolean,
)
from robosmi.query.any_operations import (
    as_date as as_date,
)
from robosmi.query.any_operations import (
    as_integer as as_integer,
)
from robosmi.query.any_operations import (
    as_long as as_long,
)
from robosmi.query.any_operations import (
    as_ordered_set as as_ordered_set,
)
from robosmi.query.any_operations import (
    as_real as as_real,
)
from robosmi.query.any_operations import (
    as_sequence as as_sequence,
)
from robosmi.query.any_operations import (
    as_set as as_set,
)
from robosmi.query.any_operations import (
    as_unicode as as_unicode,
)
from robosmi.query.any_operations import (
    e_all_contents as e_all_contents,
)
from robosmi.query.any_operations import (
    e_class as e_class,
)
from robosmi.query.any_operations import (
    e_container as e_container,
)
from robosmi.query.any_operations import (
    e_containing_feature as e_containing_feature,
)
from robosmi.query.any_operations import (
    e_contents as e_contents,
)
from robosmi.query.any_operations import (
    e_cross_references as e_cross_references,
)
from robosmi.query.any_operations import (
    e_get as e_get,
)
from robosmi.query.any_operations import (
    e_is_set as e_is_set,
)
from robosmi.query.any_operations import (
    e_resource as e_resource,
)
from robosmi.query.any_operations import (
    e_root_container as e_root_container,
)
from robosmi.query.any_operations import (
    err as err,
)
from robosmi.query.any_operations import (
    errln as errln,
)
from robosmi.query.any_operations import (
    format_ as format_,
)
from robosmi.query.any_operations import (
    if_undefined as if_undefined,
)
from robosmi.query.any_operations import (
    is_defined as is_defined,
)
from robosmi.query.any_operations import (
    is_integer as is_integer,
)
from robosmi.query.any_operations import (
    is_real as is_real,
)
from robosmi.query.any_operations import (
    is_undefined as is_undefined,
)
from robosmi.query.any_operations import (
    native_type as native_type,
)
from robosmi.query.any_operations import (
    print_ as print_,
)
from robosmi.query.any_operations import (
    println as println,
)
from robosmi.query.any_operations import (
    size as size,
)
