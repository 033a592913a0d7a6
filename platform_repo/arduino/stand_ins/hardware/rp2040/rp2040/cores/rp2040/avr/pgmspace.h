// Flash is in the address space of data: these names read it as it is.
#pragma once
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#define PROGMEM
#define PGM_P const char *
#define PGM_VOID_P const void *
#define PSTR(text) (text)
typedef char prog_char;

#define pgm_read_byte(place) (*(const uint8_t *)(place))
#define pgm_read_word(place) (*(const uint16_t *)(place))
#define pgm_read_dword(place) (*(const uint32_t *)(place))
#define pgm_read_float(place) (*(const float *)(place))
#define pgm_read_ptr(place) (*(const void *const *)(place))
#define pgm_read_byte_near(place) pgm_read_byte(place)
#define pgm_read_word_near(place) pgm_read_word(place)
#define pgm_read_dword_near(place) pgm_read_dword(place)
#define pgm_read_float_near(place) pgm_read_float(place)
#define pgm_read_byte_far(place) pgm_read_byte(place)
#define pgm_read_word_far(place) pgm_read_word(place)
#define memcpy_P memcpy
#define memcmp_P memcmp
#define strcpy_P strcpy
#define strncpy_P strncpy
#define strcat_P strcat
#define strncat_P strncat
#define strcmp_P strcmp
#define strncmp_P strncmp
#define strcasecmp_P strcasecmp
#define strlen_P strlen
#define strnlen_P strnlen
#define strstr_P strstr
#define strchr_P strchr
#define sprintf_P sprintf
#define snprintf_P snprintf
#define vsnprintf_P vsnprintf
