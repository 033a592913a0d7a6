/* avr-libc 2.0, avr/pgmspace.h: names and signatures. */
#pragma once
#include <stddef.h>
#include <stdint.h>
#include <stdarg.h>
#include <stdio.h>
#define PROGMEM
#define PGM_P const char *
#define PGM_VOID_P const void *
#define PSTR(s) (s)
#define pgm_read_byte_near(address) (*(const uint8_t *)(address))
#define pgm_read_word_near(address) (*(const uint16_t *)(address))
#define pgm_read_dword_near(address) (*(const uint32_t *)(address))
#define pgm_read_float_near(address) (*(const float *)(address))
#define pgm_read_ptr_near(address) (*(void *const *)(address))
#define pgm_read_byte_far(address) (*(const uint8_t *)(address))
#define pgm_read_word_far(address) (*(const uint16_t *)(address))
#define pgm_read_dword_far(address) (*(const uint32_t *)(address))
#define pgm_read_float_far(address) (*(const float *)(address))
#define pgm_read_ptr_far(address) (*(void *const *)(address))
#define pgm_read_byte(address) (*(const uint8_t *)(address))
#define pgm_read_word(address) (*(const uint16_t *)(address))
#define pgm_read_dword(address) (*(const uint32_t *)(address))
#define pgm_read_float(address) (*(const float *)(address))
#define pgm_read_ptr(address) (*(void *const *)(address))
#define pgm_get_far_address(var) ((uint32_t)&(var))
typedef char prog_char;
typedef unsigned char prog_uchar;
typedef int8_t prog_int8_t;
typedef uint8_t prog_uint8_t;
typedef int16_t prog_int16_t;
typedef uint16_t prog_uint16_t;
typedef int32_t prog_int32_t;
typedef uint32_t prog_uint32_t;
#ifdef __cplusplus
extern "C" {
#endif
void *memcpy_P(void *dest, const void *src, size_t n);
void *memccpy_P(void *dest, const void *src, int val, size_t n);
int memcmp_P(const void *a, const void *b, size_t n);
const void *memchr_P(const void *s, int val, size_t n);
void *memmem_P(const void *a, size_t n, const void *b, size_t m);
char *strcpy_P(char *dest, const char *src);
char *strncpy_P(char *dest, const char *src, size_t n);
char *strcat_P(char *dest, const char *src);
char *strncat_P(char *dest, const char *src, size_t n);
size_t strlcpy_P(char *dest, const char *src, size_t n);
size_t strlcat_P(char *dest, const char *src, size_t n);
int strcmp_P(const char *a, const char *b);
int strncmp_P(const char *a, const char *b, size_t n);
int strcasecmp_P(const char *a, const char *b);
int strncasecmp_P(const char *a, const char *b, size_t n);
size_t strlen_P(const char *src);
size_t strnlen_P(const char *src, size_t n);
char *strstr_P(const char *a, const char *b);
char *strcasestr_P(const char *a, const char *b);
const char *strchr_P(const char *s, int val);
const char *strrchr_P(const char *s, int val);
char *strpbrk_P(const char *s, const char *accept);
char *strtok_P(char *s, const char *delim);
size_t strspn_P(const char *s, const char *accept);
size_t strcspn_P(const char *s, const char *reject);
int printf_P(const char *format, ...);
int sprintf_P(char *s, const char *format, ...);
int snprintf_P(char *s, size_t n, const char *format, ...);
int vsnprintf_P(char *s, size_t n, const char *format, va_list ap);
int sscanf_P(const char *buf, const char *format, ...);
int puts_P(const char *str);
#ifdef __cplusplus
}
#endif
