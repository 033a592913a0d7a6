"""Programs with more nesting than people write, sums of hundreds of terms, macros within macros, no slower than their size."""

from __future__ import annotations

from pathlib import Path

from tests.widths.test_plan import changed


def test_deep_sums_and_macros_within_macros_are_read_as_far_as_they_go(tmp_path: Path) -> None:
    program = tmp_path / "deep.c"
    chain = "\n".join(f"#define M{n}(x) M{n - 1}(x)" for n in range(1, 300))
    program.write_text(
        f"short a;\n#define M0(x) ((x) + 1)\n{chain}\nint f(void) {{ return {' + '.join(['a'] * 300)}; }}\n"
        "int g(void) { return M299(a) + M50(a); }\nint main(void) {}\n"
    )
    text = changed(program)
    assert "return (int32_t)a + a + a" in text
    assert "#define M0(x) ((x) + 1L)" in text


def test_what_a_chain_of_hundreds_of_macros_computes_is_widened(tmp_path: Path) -> None:
    program = tmp_path / "chain.c"
    chain = "\n".join(f"#define C{n} C{n - 1}" for n in range(1, 300))
    program.write_text(f"#define C0 (200)\n{chain}\nint f(void) {{ return C299 * 200; }}\nint main(void) {{}}\n")
    assert "#define C0 (200L)" in changed(program)
