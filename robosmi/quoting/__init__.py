"""Quoting: writes untrusted text so that it remains text, with one function for each syntactic place.

`code` covers C and names, `markup` Markdown, HTML, SVG and diagrams, `data` TOML, YAML, CSV and JSON, `text`
the terminal and common parts. Each function leaves harmless texts unchanged. `generate.languages` determines the place of each
template expression.
"""

from robosmi.quoting.code import c_block_comment, c_char, c_comment, c_header, c_string, c_word, file_name, identifier
from robosmi.quoting.data import csv_cell, csv_record_cell, csv_text, json_text, toml, yaml, yaml_line
from robosmi.quoting.markup import (
    dot_label,
    dot_string,
    html,
    html_attribute,
    html_comment,
    html_url,
    markdown,
    markdown_block,
    markdown_cell,
    markdown_code,
    markdown_code_cell,
    plantuml,
    xml,
    xml_attribute,
    xml_comment,
)
from robosmi.quoting.text import Quoted, one_line, terminal, terminal_lines, visible

__all__ = [
    "Quoted",
    "c_block_comment",
    "c_char",
    "c_comment",
    "c_header",
    "c_string",
    "c_word",
    "csv_cell",
    "csv_record_cell",
    "csv_text",
    "dot_label",
    "dot_string",
    "file_name",
    "html",
    "html_attribute",
    "html_comment",
    "html_url",
    "identifier",
    "json_text",
    "markdown",
    "markdown_block",
    "markdown_cell",
    "markdown_code",
    "markdown_code_cell",
    "one_line",
    "plantuml",
    "terminal",
    "terminal_lines",
    "toml",
    "visible",
    "xml",
    "xml_attribute",
    "xml_comment",
    "yaml",
    "yaml_line",
]
