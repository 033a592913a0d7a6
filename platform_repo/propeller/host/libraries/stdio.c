/* stdio.h on the console. Formats are those of C99; doubles of the program have 4 bytes. Files are not modelled. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "host.h"

enum { CONSOLE_BIT_TICKS = HOST_HZ / 115200 };
struct robosmi_file { int writes, pushed; };
static struct robosmi_file input = {0, EOF}, output = {1, EOF}, errors = {1, EOF};
FILE *stdin = &input, *stdout = &output, *stderr = &errors;

static void put(char c) {
  host_send_for(10 * CONSOLE_BIT_TICKS);
  host_console_write(c);
}

static int is_console(FILE *stream) {
  if (stream != &input && stream != &output && stream != &errors) host_unmodelled("files");
  return 1;
}

static int write_text(FILE *stream, const char *format, va_list values) {
  char text[4096];
  is_console(stream);
  int count = host_print(text, sizeof text, format, values);
  if (count >= (int)sizeof text) host_end("crashed", "printf makes a text of more than 4,095 characters");
  for (int i = 0; i < count; i++) put(text[i]);
  return count;
}

#define WITH_VALUES(last, result) \
  va_list values; va_start(values, last); int count = result; va_end(values); return count

int printf(const char *format, ...) { WITH_VALUES(format, write_text(stdout, format, values)); }
int __simple_printf(const char *format, ...) { WITH_VALUES(format, write_text(stdout, format, values)); }
int fprintf(FILE *stream, const char *format, ...) { WITH_VALUES(format, write_text(stream, format, values)); }
int vprintf(const char *format, va_list list) { return write_text(stdout, format, list); }
int vfprintf(FILE *stream, const char *format, va_list list) { return write_text(stream, format, list); }
int sprintf(char *s, const char *format, ...) { WITH_VALUES(format, host_print(s, 0x7FFFFFFF, format, values)); }
int snprintf(char *s, size_t n, const char *format, ...) { WITH_VALUES(format, host_print(s, n, format, values)); }
int vsprintf(char *s, const char *format, va_list list) { return host_print(s, 0x7FFFFFFF, format, list); }
int vsnprintf(char *s, size_t n, const char *format, va_list list) { return host_print(s, n, format, list); }
int sscanf(const char *s, const char *format, ...) { WITH_VALUES(format, host_scan(s, format, values)); }

int fputc(int c, FILE *stream) {
  is_console(stream);
  put(c);
  return (unsigned char)c;
}

int putc(int c, FILE *stream) { return fputc(c, stream); }
int putchar(int c) { return fputc(c, stdout); }

int fputs(const char *s, FILE *stream) {
  for (; *s; s++) fputc(*s, stream);
  return 0;
}

int puts(const char *s) {
  fputs(s, stdout);
  return fputc('\n', stdout);
}

size_t fwrite(const void *from, size_t size, size_t count, FILE *stream) {
  for (size_t i = 0; i < size * count; i++) fputc(((const char *)from)[i], stream);
  return count;
}

int fflush(FILE *stream) {
  (void)stream;
  return 0;
}

/* A carriage return that was typed is read as the end of a line. */
int fgetc(FILE *stream) {
  is_console(stream);
  int c = stream->pushed;
  stream->pushed = EOF;
  if (c == EOF) c = host_console_read(HOST_NEVER);
  return c == '\r' ? '\n' : c;
}

int getc(FILE *stream) { return fgetc(stream); }
int getchar(void) { return fgetc(stdin); }

int ungetc(int c, FILE *stream) {
  is_console(stream);
  return stream->pushed = c;
}

char *fgets(char *s, int n, FILE *stream) {
  int count = 0;
  while (count < n - 1) {
    int c = fgetc(stream);
    if (c < 0) break;
    s[count++] = c;
    if (c == '\n') break;
  }
  s[count] = 0;
  return count ? s : 0;
}

char *gets(char *s) {
  fgets(s, 0x7FFFFFFF, stdin);
  s[strcspn(s, "\n")] = 0;
  return s;
}

/* A line is read whole and scanned; what is left of it is lost, and an empty one is read over, as white space is. */
static int scan_line(FILE *stream, const char *format, va_list places) {
  char line[512];
  do fgets(line, sizeof line, stream);
  while (strspn(line, " \t\n") == strlen(line));
  return host_scan(line, format, places);
}

int scanf(const char *format, ...) { WITH_VALUES(format, scan_line(stdin, format, values)); }
int fscanf(FILE *stream, const char *format, ...) { WITH_VALUES(format, scan_line(stream, format, values)); }
int setvbuf(FILE *stream, char *buffer, int mode, size_t size) { (void)stream, (void)buffer, (void)mode, (void)size; return 0; }
void setbuf(FILE *stream, char *buffer) { (void)stream, (void)buffer; }

/* The number of the error stands for its words. */
void perror(const char *message) {
  if (message && *message) fprintf(stderr, "%s: ", message);
  fprintf(stderr, "error %d\n", errno);
}
