"""The platform repository: data about platforms, boards, parts and libraries; read through `robosmi.resources`."""
