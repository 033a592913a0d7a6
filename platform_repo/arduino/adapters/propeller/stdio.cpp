//# header stdio.h
// printf, scanf and single characters on the terminal. Read from propgcc b280e7a77, lib/stdio. What the functions of the target's own
// library lack is here: 32 bits of integer for any argument, and floats. Files are on a card. The target's own fread, fwrite, fgets, fputs,
// fgetc, fputc and feof work on them.
//# task setbuf writes to the terminal and to a file go on at once; take the call out
//# task setvbuf writes to the terminal and to a file go on at once; take the call out

//# helper FloatText
//#   include: <math.h>
//#   fidelity: as there the digits behind the point are one integer, so that 0.1 with nine places is 0.100000000
//#   include mbed_nano renesas_uno: <api/itoa.h>
struct FloatText {
  char text[64];
  uint8_t length;

  void put(char c) { text[length++] = c; }
  void number(uint32_t value, uint8_t least) {
    char digits[11];
    ultoa(value, digits, 10);
    for (uint8_t number = strlen(digits); number < least; number++) put('0');
    for (const char *at = digits; *at; at++) put(*at);
  }
  static float power(int8_t exponent) {
    float result = 1, base = exponent < 0 ? 0.1 : 10;
    for (uint8_t left = abs(exponent); left; left >>= 1, base *= base)
      if (left & 1) result *= base;
    return result;
  }

  FloatText(float value, char style, int16_t precision, bool keep) : length(0) {
    bool general = style == 'g', scientific = general || style == 'e', zeros = keep || !general;
    int8_t exponent = 0;
    if (precision < 0) precision = 6;
    if (precision > 30) precision = 30;
    if (general && precision > 0) precision--;
    if (scientific && value > 0) {
      float rest = value;
      for (; rest < 1 && exponent > -60; exponent--) rest *= 10;
      for (; rest >= 10; exponent++) rest /= 10;
    }
    uint32_t whole, fraction;
    uint8_t places, tens;
    for (;;) {
      float scaled = scientific ? value / power(exponent) : value;
      for (tens = 0; scaled >= 4294967040.0f; tens++) scaled /= 10;
      places = precision < 9 ? precision : 9;
      whole = (uint32_t)scaled;
      uint32_t mask = (uint32_t)power(places);
      float behind = mask * (scaled - whole);
      fraction = (uint32_t)behind;
      if (behind - fraction >= 0.5f) fraction++;
      if (fraction >= mask) {
        whole++;
        fraction = 0;
        if (scientific && whole == 10) {
          whole = 1;
          exponent++;
        }
      }
      if (!general || !scientific || precision < exponent || exponent < -4) break;
      precision -= exponent;
      scientific = false;
    }
    number(whole, 0);
    for (; tens; tens--) put('0');
    uint8_t begun = length;
    if (precision > 0 || keep) put('.');
    if (precision > 0) number(fraction, places);
    for (int16_t place = places; place < precision; place++) put('0');
    while (!zeros && length > begun && (text[length - 1] == '0' || text[length - 1] == '.'))
      if (text[--length] == '.') break;
    if (scientific) {
      put('e');
      put(exponent < 0 ? '-' : '+');
      number(abs(exponent), 2);
    }
    text[length] = 0;
  }
};

//# helper printf_text
//#   needs: simpletext.h/TextOut simpletext.h/TextArgument FloatText
//#   include: <math.h>
//#   fidelity: flags, width, precision, *, h, hh, l and the conversions d i u o x X c s p f F e E g G and %
//#   include mbed_nano renesas_uno: <api/itoa.h>
inline int32_t printf_text(TextOut out, const char *format, const TextArgument *given, uint8_t count) {
  const TextArgument none, *last = given + count;
  for (; *format; format++) {
    if (*format != '%') {
      out.put(*format);
      continue;
    }
    bool left = false, alternate = false;
    char plus = 0, filler = ' ';
    for (format++; *format && strchr("-+ #0'", *format); format++) {
      if (*format == '-') left = true;
      if (*format == '#') alternate = true;
      if (*format == '0') filler = '0';
      if (*format == '+' || (*format == ' ' && !plus)) plus = *format;
    }
    int32_t numbers[2] = {0, -1};  // width and precision
    for (uint8_t which = 0; which < 2; which++) {
      if (which && *format != '.') break;
      if (which) numbers[1] = 0, format++;
      if (*format == '*') {
        numbers[which] = given < last ? (*given++).number() : 0;
        format++;
      }
      for (; isdigit((uint8_t)*format); format++) numbers[which] = 10 * numbers[which] + (*format - '0');
    }
    int32_t width = numbers[0], precision = numbers[1];
    if (width < 0) left = true, width = -width;
    uint8_t half = 0;
    for (; *format && strchr("hlLjtz", *format); format++) half += *format == 'h';
    char conversion = *format;
    if (!conversion) break;
    if (conversion == '%') out.put('%');
    if (!strchr("diuoxXcspfFeEgGaA", conversion)) continue;
    const TextArgument &argument = given < last ? *given++ : none;
    int32_t value = argument.number();
    char sign = 0, digits[12];
    const char *text = digits, *prefix = "";
    int32_t zeros = 0, length;
    if (conversion == 'c' || conversion == 's') {
      digits[0] = (char)value;
      digits[1] = 0;
      if (conversion == 's') text = argument.kind == 's' ? argument.text ? argument.text : "(null)" : "";
      length = conversion == 'c' ? 1 : strlen(text);
      if (conversion == 's' && precision >= 0 && length > precision) length = precision;
      filler = ' ';
    } else if (strchr("fFeEgGaA", conversion)) {
      float real = argument.kind == 'f' ? argument.real : value;
      char style = conversion | 32;
      FloatText converted(isfinite(real) ? fabs(real) : 0, style == 'a' ? 'f' : style, precision, alternate);
      text = isnan(real) ? "nan" : isinf(real) ? "inf" : converted.text;
      sign = real < 0 ? '-' : plus;
      length = strlen(text);
      if (!isfinite(real)) filler = ' ';
      if (filler == '0' && !left) zeros = width - length - (sign != 0);
      out.fill(left || filler == '0' ? 0 : width - length - (sign != 0), ' ');
      if (sign) out.put(sign);
      out.fill(zeros, '0');
      for (const char *at = text; *at; at++) out.put(conversion < 'a' ? (char)toupper(*at) : *at);
      if (left) out.fill(width - length - (sign != 0), ' ');
      continue;
    } else {
      bool negative_too = conversion == 'd' || conversion == 'i';
      if (half == 1) value = negative_too ? (int32_t)(int16_t)value : (int32_t)(uint16_t)value;
      if (half == 2) value = negative_too ? (int8_t)value : (uint8_t)value;
      uint8_t base = conversion == 'o' ? 8 : conversion == 'p' || (conversion | 32) == 'x' ? 16 : 10;
      sign = !negative_too ? 0 : value < 0 ? '-' : plus;
      ultoa(sign == '-' ? -(uint32_t)value : (uint32_t)value, digits, base);
      if (conversion == 'X') strupr(digits);
      length = strlen(digits);
      if ((alternate || conversion == 'p') && value && base == 16) prefix = conversion == 'X' ? "0X" : "0x";
      zeros = precision > length ? precision - length : 0;
      if (alternate && value && base == 8 && !zeros) zeros = 1;
      length += zeros + strlen(prefix) + (sign != 0);
      if (filler == '0' && precision < 0 && !left && width > length) zeros += width - length, length = width;
      out.fill(left ? 0 : width - length, ' ');
      if (sign) out.put(sign);
      out.put(prefix);
      out.fill(zeros, '0');
      out.put(digits);
      if (left) out.fill(width - length, ' ');
      continue;
    }
    out.fill(left ? 0 : width - length, ' ');
    for (int32_t number = 0; number < length; number++) out.put(text[number]);
    if (left) out.fill(width - length, ' ');
  }
  if (out.memory && out.room > 0) out.memory[out.count < out.room ? out.count : out.room - 1] = 0;
  return out.count;
}

//# adapter printf
//#   for: int printf(const char *fmt, ...)
//#   kind: semantic
//#   name: c_printf
//#   needs: simpletext.h/dport_ptr simpletext.h/TextOut simpletext.h/TextArgument printf_text
//#   fidelity: exact but for line ends, floats too
//#   limit: 32 bits of an integer are printed, of %lld too; at most 9 digits behind the point, then zeros
//#   stack: 183 165
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
template <class... Arguments>
inline int32_t c_printf(const char *fmt, Arguments... given) {
  const TextArgument arguments[] = {TextArgument(), given...};
  return printf_text(TextOut(dport_ptr), fmt, arguments + 1, sizeof...(given));
}

//# adapter sprintf
//#   for: int sprintf(char *str, const char *format, ...)
//#   kind: semantic
//#   name: c_sprintf
//#   needs: simpletext.h/TextOut simpletext.h/TextArgument printf_text
//#   fidelity: exact, floats too
//#   limit: 32 bits of an integer are printed, of %lld too; at most 9 digits behind the point, then zeros
//#   stack: 183 164
template <class... Arguments>
inline int32_t c_sprintf(char *str, const char *format, Arguments... given) {
  const TextArgument arguments[] = {TextArgument(), given...};
  return printf_text(TextOut(str), format, arguments + 1, sizeof...(given));
}

//# adapter snprintf
//#   for: int snprintf(char *str, size_t size, const char *format, ...)
//#   kind: semantic
//#   name: c_snprintf
//#   needs: simpletext.h/TextOut simpletext.h/TextArgument printf_text
//#   fidelity: exact, floats too
//#   limit: 32 bits of an integer are printed, of %lld too; at most 9 digits behind the point, then zeros
//#   stack: 183 165
template <class... Arguments>
inline int32_t c_snprintf(char *str, uint32_t size, const char *format, Arguments... given) {
  const TextArgument arguments[] = {TextArgument(), given...};
  return printf_text(TextOut(str, size), format, arguments + 1, sizeof...(given));
}

//# adapter putchar
//#   for: int putchar(int c)
//#   kind: oneToOne
//#   name: c_putchar
//#   needs: simpletext.h/putChar
//#   fidelity: exact but for line ends
//#   stack: 12 8
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline int32_t c_putchar(int32_t c) {
  putChar((char)c);
  return c;
}

//# adapter puts
//#   for: int puts(const char *s)
//#   kind: oneToMany
//#   name: c_puts
//#   needs: simpletext.h/putStr simpletext.h/putChar
//#   fidelity: exact but for line ends; an empty text prints nothing, as there
//#   stack: 24 12
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline int32_t c_puts(const char *s) {
  int32_t count = putStr(s);
  if (!count) return 0;
  putChar('\n');
  return count + 1;
}

//# adapter getchar
//#   for: int getchar(void)
//#   kind: oneToOne
//#   name: c_getchar
//#   needs: simpletext.h/getChar
//#   fidelity: it waits; a carriage return is read as a line feed. What is typed is not shown
//#   stack: 6
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline int32_t c_getchar() {
  int32_t c = getChar();
  return c == '\r' ? '\n' : c;
}

//# adapter gets
//#   for: char *gets(char *buf)
//#   kind: oneToMany
//#   name: c_gets
//#   needs: getchar
//#   fidelity: exact: up to the end of the line
//#   stack: 8 6
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline char *c_gets(char *buf) {
  char *end = buf;
  for (int32_t c; (c = c_getchar()) != '\n';) *end++ = (char)c;
  *end = 0;
  return buf;
}

//# helper scanf_text
//#   needs: simpletext.h/ScanTarget
//#   include: <math.h>
//#   fidelity: * and widths and the conversions d i u o x X c s [ f e g n and %; -1 when a text ends before anything was read
inline int32_t scanf_text(const char *text, const char *format, const ScanTarget *targets, uint8_t count) {
  const ScanTarget *last = targets + count;
  const char *begun = text;
  int32_t filled = 0;
  for (; *format; format++) {
    if (isspace((uint8_t)*format)) {
      while (isspace((uint8_t)*text)) text++;
      continue;
    }
    if (*format != '%') {
      if (*text != *format) break;
      text++;
      continue;
    }
    uint16_t width = 0;
    for (format++; isdigit((uint8_t)*format); format++) width = 10 * width + (*format - '0');
    bool ignored = *format == '*';
    if (ignored) format++;
    for (; !width && isdigit((uint8_t)*format); format++) width = 10 * width + (*format - '0');
    while (*format && strchr("hlLjtz", *format)) format++;
    char conversion = *format;
    if (conversion == '%') {
      if (*text != '%') break;
      text++;
      continue;
    }
    if (!conversion || (!ignored && targets == last)) break;
    const ScanTarget &target = ignored ? *last : *targets++;
    if (conversion == 'n') {
      if (!ignored) target.take((int32_t)(text - begun));
      filled++;
      continue;
    }
    if (conversion != 'c' && conversion != '[')
      while (isspace((uint8_t)*text)) text++;
    if (!*text) return filled ? filled : -1;
    if (conversion == 'c' || conversion == 's' || conversion == '[') {
      const char *set = format + 1;
      bool without = conversion == '[' && *set == '^';
      if (without) set++;
      if (conversion == '[') {
        format = set + (*set == ']');
        while (*format && *format != ']') format++;
      }
      uint16_t taken = 0, most = width ? width : conversion == 'c' ? 1 : 65535U;
      for (; taken < most && *text; taken++, text++) {
        if (conversion == 's' && isspace((uint8_t)*text)) break;
        bool among = false;
        for (const char *at = set; conversion == '[' && at < format; at++) {
          bool range = at[1] == '-' && at + 2 < format;
          among = among || (range ? *text >= at[0] && *text <= at[2] : *text == *at);
          if (range) at += 2;
        }
        if (conversion == '[' && among == without) break;
        if (!ignored) ((char *)target.at)[taken] = *text;
      }
      if (!taken) break;
      if (!ignored && conversion != 'c') ((char *)target.at)[taken] = 0;
    } else {
      char part[32], *end;
      strncpy(part, text, sizeof part - 1);
      part[width && width < sizeof part ? width : sizeof part - 1] = 0;
      if (strchr("fegFEG", conversion)) {
        float real = strtod(part, &end);
        if (!ignored) target.take(real);
      } else {
        uint8_t base = strchr("xXp", conversion) ? 16 : conversion == 'o' ? 8 : conversion == 'i' ? 0 : 10;
        int32_t value = *part == '-' ? strtol(part, &end, base) : (int32_t)strtoul(part, &end, base);
        if (!ignored && end != part) target.take(value);
      }
      if (end == part) break;
      text += end - part;
    }
    filled += !ignored;
  }
  return filled;
}

//# adapter sscanf
//#   for: int sscanf(const char *str, const char *fmt, ...)
//#   kind: semantic
//#   name: c_sscanf
//#   needs: simpletext.h/ScanTarget scanf_text
//#   fidelity: exact: integers of any width are filled, and floats
//#   stack: 115 91
template <class... Targets>
inline int32_t c_sscanf(const char *str, const char *fmt, Targets... targets) {
  const ScanTarget variables[] = {ScanTarget(), targets...};
  return scanf_text(str, fmt, variables + 1, sizeof...(targets));
}

//# adapter scanf
//#   for: int scanf(const char *fmt, ...)
//#   kind: semantic
//#   name: c_scanf
//#   needs: simpletext.h/ScanTarget scanf_text simpletext.h/getStr
//#   fidelity: integers of any width are filled, and floats. What is typed is not shown
//#   limit: each call reads one line of at most 80 characters, and leaves nothing of it for the next call
//#   stack: 196 174
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
template <class... Targets>
inline int32_t c_scanf(const char *fmt, Targets... targets) {
  char line[81];
  const ScanTarget variables[] = {ScanTarget(), targets...};
  return scanf_text(getStr(line, 80), fmt, variables + 1, sizeof...(targets));
}

// ---------------------------------------------------------------- files

//# helper open_files
//#   needs: hal/own_files
//#   include: <SD.h> <stdio.h>
//#   library: SD
//#   fidelity: two files can be open at a time; each is a stream of the target's library
//#   ram: 58
struct OpenFile {
  OwnFile stream;
  File file;
};
static OpenFile open_files[2];

//# helper file_of
//#   needs: open_files hal/own_files
//#   include: <SD.h> <stdio.h>
inline File *file_of(FILE *stream) {
  for (OpenFile &each : open_files)
    if (is_own_file(each.stream, stream) && each.file) return &each.file;
  return 0;
}

//# adapter fopen
//#   for: FILE *fopen(const char *name, const char *mode)
//#   kind: semantic
//#   needs: open_files file_of hal/own_files
//#   include: <SD.h> <stdio.h>
//#   library: SD
//#   fidelity: exact: 0 when the file cannot be opened; the modes r, w, a and each with +
//#   limit avr: two files at a time, with names of 8 and 3 characters; 12 KB of program memory and 700 bytes of RAM
//#   limit other: two files at a time
//#   stack: 27 19
inline FILE *fopen(const char *name, const char *mode) {
  uint8_t how = O_READ;
  if (*mode != 'r' || strchr(mode, '+')) how |= O_WRITE;
  if (*mode != 'r') how |= *mode == 'w' ? O_CREAT | O_TRUNC : O_CREAT | O_APPEND;
  for (OpenFile &each : open_files) {
    if (each.file) continue;
    each.file = SD.open(name, how);
    if (!each.file) return 0;
    if (*mode != 'a') each.file.seek(0);
    return open_own_file(
        each.stream, [](char c, FILE *stream) { return file_of(stream)->write((uint8_t)c) == 1 ? 0 : 1; },
        [](FILE *stream) {
          int c = file_of(stream)->read();
          return c < 0 ? end_of_own_file : c;
        },
        static_cast<Stream *>(&each.file));
  }
  return 0;
}

//# adapter fclose
//#   for: int fclose(FILE *fp)
//#   kind: semantic
//#   name: c_fclose
//#   needs: file_of
//#   include: <SD.h> <stdio.h>
//#   library: SD
//#   fidelity: exact: 0, or -1 when it is not open
//#   stack: 25
inline int32_t c_fclose(FILE *fp) {
  File *file = file_of(fp);
  if (!file) return -1;
  file->close();
  return 0;
}

//# adapter fseek
//#   for: int fseek(FILE *fp, long offset, int whence)
//#   kind: semantic
//#   name: c_fseek
//#   needs: file_of
//#   include: <SD.h> <stdio.h>
//#   library: SD
//#   fidelity: exact: 0, or -1 when the file has no such place
//#   stack: 21 7
inline int32_t c_fseek(FILE *fp, int32_t offset, int32_t whence) {
  File *file = file_of(fp);
  if (!file) return -1;
  int32_t to = offset + (whence == SEEK_SET ? 0 : whence == SEEK_CUR ? file->position() : file->size());
  clearerr(fp);
  return to >= 0 && file->seek(to) ? 0 : -1;
}

//# adapter ftell
//#   for: long ftell(FILE *fp)
//#   kind: semantic
//#   name: c_ftell
//#   needs: file_of
//#   include: <SD.h> <stdio.h>
//#   library: SD
//#   fidelity: exact
//#   stack: 0
inline int32_t c_ftell(FILE *fp) {
  File *file = file_of(fp);
  return file ? (int32_t)file->position() : -1;
}

//# adapter rewind
//#   for: void rewind(FILE *fp)
//#   kind: oneToOne
//#   name: c_rewind
//#   needs: fseek
//#   fidelity: exact
//#   stack: 6 2
inline void c_rewind(FILE *fp) {
  c_fseek(fp, 0, SEEK_SET);
}

// ---------------------------------------------------------------- the console as a file

//# helper console_file
//#   needs: putchar getchar hal/own_files
//#   include: <stdio.h>
//#   setup: stdin = stdout = stderr = console_file();
//#   fidelity: the target's own functions for files read and write the terminal, as stdin, stdout and stderr
//#   ram: 14
inline FILE *console_file() {
  static OwnFile file;
  return open_own_file(
      file, [](char c, FILE *) { return (int)(c_putchar(c) < 0); }, [](FILE *) { return (int)c_getchar(); }, 0);
}

inline bool is_file(const FILE *file) {
  return file != 0;
}

//# helper file_stream
//#   needs: hal/own_files
//#   include: <stdio.h>
// The file that a stream stands for; 0 for the terminal, which is none
inline Stream *file_stream(FILE *fp) {
  return static_cast<Stream *>(about_own_file(fp));
}

//# adapter fflush
//#   for: int fflush(FILE *fp)
//#   kind: semantic
//#   name: c_fflush
//#   needs: console_file file_stream
//#   fidelity: exact: what was written is on the card; of the terminal there is nothing to do
//#   stack: 13 11
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline int32_t c_fflush(FILE *fp) {
  Stream *file = is_file(fp) ? file_stream(fp) : 0;
  if (file) file->flush();
  return 0;
}

//# adapter fprintf
//#   for: int fprintf(FILE *fp, const char *fmt, ...)
//#   kind: semantic
//#   name: c_fprintf
//#   needs: console_file file_stream printf_text simpletext.h/text_t simpletext.h/dport_ptr simpletext.h/TextOut simpletext.h/TextArgument
//#   fidelity: exact, floats too; to stdout and stderr it prints on the terminal; -1 without a file
//#   limit: 32 bits of an integer are printed, of %lld too; at most 9 digits behind the point, then zeros
//#   stack: 194 176
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
template <class... Arguments>
inline int32_t c_fprintf(FILE *fp, const char *fmt, Arguments... given) {
  if (!is_file(fp)) return -1;
  const TextArgument arguments[] = {TextArgument(), given...};
  text_t device = text_t();
  device.port = file_stream(fp);
  return printf_text(TextOut(device.port ? &device : dport_ptr), fmt, arguments + 1, sizeof...(given));
}

//# adapter fputs
//#   for: int fputs(const char *s, FILE *fp)
//#   kind: oneToOne
//#   name: c_fputs
//#   needs: console_file
//#   include: <stdio.h>
//#   fidelity: exact but for line ends; -1 without a file
//#   stack: 19
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline int32_t c_fputs(const char *s, FILE *fp) {
  return is_file(fp) ? fputs(s, fp) : -1;
}

//# adapter fputc
//#   for: int fputc(int c, FILE *fp)
//#   kind: oneToOne
//#   name: c_fputc
//#   needs: console_file
//#   include: <stdio.h>
//#   fidelity: exact but for line ends; -1 without a file
//#   stack: 17
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline int32_t c_fputc(int32_t c, FILE *fp) {
  return is_file(fp) ? fputc((int)c, fp) : -1;
}

//# adapter putc
//#   for: int putc(int c, FILE *fp)
//#   kind: oneToOne
//#   name: c_putc
//#   needs: fputc
//#   include: <stdio.h>
//#   fidelity: exact but for line ends; -1 without a file
//#   stack: 17
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline int32_t c_putc(int32_t c, FILE *fp) {
  return c_fputc(c, fp);
}

//# adapter fgets
//#   for: char *fgets(char *s, int size, FILE *fp)
//#   kind: oneToOne
//#   name: c_fgets
//#   needs: console_file
//#   include: <stdio.h>
//#   fidelity: exact: it waits at the terminal for a line; 0 without a file. What is typed is not shown
//#   stack: 25
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline char *c_fgets(char *s, int32_t size, FILE *fp) {
  return is_file(fp) ? fgets(s, (int)size, fp) : 0;
}

//# adapter fgetc
//#   for: int fgetc(FILE *fp)
//#   kind: oneToOne
//#   name: c_fgetc
//#   needs: console_file
//#   include: <stdio.h>
//#   fidelity: exact: it waits at the terminal; -1 at the end of a file, and without one. What is typed is not shown
//#   stack: 15
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline int32_t c_fgetc(FILE *fp) {
  return is_file(fp) ? fgetc(fp) : -1;
}

//# adapter getc
//#   for: int getc(FILE *fp)
//#   kind: oneToOne
//#   name: c_getc
//#   needs: fgetc
//#   include: <stdio.h>
//#   fidelity: exact: it waits at the terminal; -1 at the end of a file, and without one. What is typed is not shown
//#   stack: 15
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline int32_t c_getc(FILE *fp) {
  return c_fgetc(fp);
}

//# adapter perror
//#   for: void perror(const char *msg)
//#   kind: semantic
//#   needs: printf
//#   include: <errno.h>
//#   fidelity: the message and the number of the error
//#   limit: the number of the error stands for its words, and functions for files set none here
//#   stack: 187 185
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline void perror(const char *msg) {
  if (msg && *msg) c_printf("%s: ", msg);
  c_printf("error %d\n", errno);
}

//# adapter remove
//#   for: int remove(const char *filename)
//#   kind: oneToOne
//#   name: c_remove
//#   include: <SD.h>
//#   library: SD
//#   fidelity: exact: 0, or -1 when there is no such file
//#   stack: 0
inline int32_t c_remove(const char *filename) {
  return SD.remove((char *)filename) ? 0 : -1;
}

// ---------------------------------------------------------------- values in a list

//# adapter vsnprintf
//#   for: int vsnprintf(char *str, size_t size, const char *format, va_list ap)
//#   for: int vsnprintf(char *str, size_t size, const char *format, __va_list ap)
//#   kind: semantic
//#   name: c_vsnprintf
//#   needs: simpletext.h/ListArguments printf_text simpletext.h/TextOut
//#   include: <stdarg.h>
//#   fidelity: exact, floats too
//#   limit: at most 12 values, of 32 bits; at most 9 digits behind the point, then zeros
//#   stack: 230 214
inline int32_t c_vsnprintf(char *str, uint32_t size, const char *format, va_list ap) {
  ListArguments given(format, ap);
  return printf_text(TextOut(str, size), format, given.values, given.count);
}

//# adapter vsprintf
//#   for: int vsprintf(char *str, const char *format, va_list ap)
//#   for: int vsprintf(char *str, const char *format, __va_list ap)
//#   kind: semantic
//#   name: c_vsprintf
//#   needs: vsnprintf
//#   include: <stdarg.h>
//#   fidelity: exact, floats too
//#   limit: at most 12 values, of 32 bits; at most 9 digits behind the point, then zeros
//#   stack: 229 211
inline int32_t c_vsprintf(char *str, const char *format, va_list ap) {
  return c_vsnprintf(str, 32767, format, ap);
}

//# adapter vprintf
//#   for: int vprintf(const char *fmt, va_list ap)
//#   for: int vprintf(const char *fmt, __va_list ap)
//#   kind: semantic
//#   name: c_vprintf
//#   needs: simpletext.h/ListArguments printf_text simpletext.h/TextOut simpletext.h/dport_ptr
//#   include: <stdarg.h>
//#   fidelity: exact but for line ends, floats too
//#   limit: at most 12 values, of 32 bits; at most 9 digits behind the point, then zeros
//#   stack: 228 210
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline int32_t c_vprintf(const char *fmt, va_list ap) {
  ListArguments given(fmt, ap);
  return printf_text(TextOut(dport_ptr), fmt, given.values, given.count);
}

//# adapter vfprintf
//#   for: int vfprintf(FILE *fp, const char *fmt, va_list ap)
//#   for: int vfprintf(FILE *fp, const char *fmt, __va_list ap)
//#   kind: semantic
//#   name: c_vfprintf
//#   needs: simpletext.h/ListArguments console_file file_stream printf_text simpletext.h/text_t simpletext.h/dport_ptr simpletext.h/TextOut
//#   include: <stdarg.h>
//#   fidelity: exact, floats too; to stdout and stderr it prints on the terminal; -1 without a file
//#   limit: at most 12 values, of 32 bits; at most 9 digits behind the point, then zeros
//#   stack: 240 222
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline int32_t c_vfprintf(FILE *fp, const char *fmt, va_list ap) {
  if (!is_file(fp)) return -1;
  ListArguments given(fmt, ap);
  text_t device = text_t();
  device.port = file_stream(fp);
  return printf_text(TextOut(device.port ? &device : dport_ptr), fmt, given.values, given.count);
}
