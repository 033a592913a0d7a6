/* Minimal iso646.h for reading programs (C99/POSIX names and types only). */
#ifndef ROBOSMI_ISO646_H
#define ROBOSMI_ISO646_H
#define and &&
#define and_eq &=
#define bitand &
#define bitor |
#define compl ~
#define not !
#define not_eq !=
#define or ||
#define or_eq |=
#define xor ^
#define xor_eq ^=
#endif
