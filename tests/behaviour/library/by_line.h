/* Included before everything else: text is written line by line, so that what a program has said when it is ended is there. */
#include <stdio.h>
static void __attribute__((constructor)) write_by_line(void) { setvbuf(stdout, 0, _IOLBF, 0); }
