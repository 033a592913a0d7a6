"""Platforms: APIs, targets, toolchain facts, stored platforms, as `platform.ecore` describes them.

`target_platform` is the view of a target, `platform_api` the view of an API.
Imports `adapters` and the modules of `knowledge`; queries, rules and chains may import it.
"""
