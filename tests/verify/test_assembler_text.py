"""Which assembler text is let through: each refused line makes the assembler read a file, or ends a text early."""

from __future__ import annotations

import pytest

from robosmi.errors import VerificationError
from robosmi.verify.original_build import check_directives

WRITTEN = r"""
	.file	"a;b.c"
	.file 1 "/usr/include" "stdio.h"
	.section	.note.GNU-stack,"",@progbits
	.section	.text.f,"axG",@progbits,f,comdat
	.section	.rodata.str1.1,"aMS",@progbits,1
	.ident	"GCC: (Debian 12.2.0) 12.2.0"
	.string	"\"; .incbin \"x\\"
	.type	main, @function
#APP
# 5 "a.c" 1
	nop
# 0 "" 2
#NO_APP
"""


def test_what_a_compiler_writes_is_let_through() -> None:
    check_directives(WRITTEN)


@pytest.mark.parametrize(
    "line",
    [
        '.type x,"object;.incbin "/s";.type x,"object',
        '# 1 "x";.incbin "/s"',
        'nop;# 1 "x" ; .include "/s"',
        '# 5 "a";.incbin "/s" 1',
        '.ident "";.incbin "/s"',
        '.section .a"b;.incbin "/s";"',
        '.section .a,"aw";.INCBIN "/s"',
        '.file "a" ;.incbin "/s"',
        '.string "a", "b" ; .incbin "/s"',
        '.size x,"a;.byte 1;"',
        '"a": .byte 1',
        '.globl "a"',
        '.byte \'"; .byte "',
        ". incbin /s",
        ".include /s",
    ],
)
def test_a_quote_elsewhere_or_a_file_is_refused(line: str) -> None:
    with pytest.raises(VerificationError, match="assembler text"):
        check_directives(f"\t.text\n{line}\n")
