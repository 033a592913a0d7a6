/* Minimal setjmp.h for reading programs (C99/POSIX names and types only). */
#ifndef ROBOSMI_SETJMP_H
#define ROBOSMI_SETJMP_H
typedef int jmp_buf[16];
int setjmp(jmp_buf buffer);
void longjmp(jmp_buf buffer, int value);
#endif
