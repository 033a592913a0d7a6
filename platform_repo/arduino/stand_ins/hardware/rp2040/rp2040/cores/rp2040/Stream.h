#pragma once
#include "Print.h"

enum LookaheadMode { SKIP_ALL, SKIP_NONE, SKIP_WHITESPACE };
#define NO_IGNORE_CHAR '\x01'

class Stream : public Print {
 public:
  virtual int available() = 0;
  virtual int read() = 0;
  virtual int peek() = 0;
  void setTimeout(unsigned long milliseconds) { timeout = milliseconds; }
  unsigned long getTimeout() { return timeout; }
  bool find(const char *target) { return find(target, strlen(target)); }
  bool find(const uint8_t *target) { return find((const char *)target); }
  bool find(char target) { return find(&target, 1); }
  bool find(const char *target, size_t length);
  bool findUntil(const char *target, const char *terminator);
  long parseInt(LookaheadMode lookahead = SKIP_ALL, char ignore = NO_IGNORE_CHAR);
  float parseFloat(LookaheadMode lookahead = SKIP_ALL, char ignore = NO_IGNORE_CHAR);
  size_t readBytes(char *to, size_t count);
  size_t readBytes(uint8_t *to, size_t count) { return readBytes((char *)to, count); }
  size_t readBytesUntil(char terminator, char *to, size_t count);
  size_t readBytesUntil(char terminator, uint8_t *to, size_t count) { return readBytesUntil(terminator, (char *)to, count); }
  String readString();
  String readStringUntil(char terminator);

 protected:
  unsigned long timeout = 1000;  // ms
  int timedRead();
  int timedPeek();

 private:
  int nextDigit(LookaheadMode lookahead, bool fraction);
  double number(LookaheadMode lookahead, char ignore, bool fraction);
};
