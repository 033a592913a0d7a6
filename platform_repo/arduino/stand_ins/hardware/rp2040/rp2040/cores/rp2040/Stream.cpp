#include <Arduino.h>

int Stream::timedRead() {
  int letter;
  for (unsigned long begun = millis(); (letter = read()) < 0;)
    if (millis() - begun >= timeout) break;
  return letter;
}

int Stream::timedPeek() {
  int letter;
  for (unsigned long begun = millis(); (letter = peek()) < 0;)
    if (millis() - begun >= timeout) break;
  return letter;
}

bool Stream::find(const char *target, size_t length) {
  size_t found = 0;
  while (found < length) {
    int letter = timedRead();
    if (letter < 0) return false;
    found = letter == target[found] ? found + 1 : letter == target[0] ? 1 : 0;
  }
  return true;
}

bool Stream::findUntil(const char *target, const char *terminator) {
  size_t found = 0, ended = 0, length = strlen(target), ends = strlen(terminator);
  while (found < length) {
    int letter = timedRead();
    if (letter < 0) return false;
    found = letter == target[found] ? found + 1 : letter == target[0] ? 1 : 0;
    ended = ends && letter == terminator[ended] ? ended + 1 : 0;
    if (ends && ended == ends && found < length) return false;
  }
  return true;
}

int Stream::nextDigit(LookaheadMode lookahead, bool fraction) {
  for (;;) {
    int letter = timedPeek();
    if (letter < 0 || letter == '-' || isdigit(letter) || (fraction && letter == '.')) return letter;
    if (lookahead == SKIP_NONE || (lookahead == SKIP_WHITESPACE && !isspace(letter))) return -1;
    read();
  }
}

double Stream::number(LookaheadMode lookahead, char ignore, bool fraction) {
  int letter = nextDigit(lookahead, fraction);
  if (letter < 0) return 0;
  bool negative = false, point = false;
  double value = 0, place = 1;
  for (; letter >= 0 && (isdigit(letter) || letter == ignore || letter == '-' || (fraction && letter == '.' && !point));
       letter = timedPeek()) {
    if (letter == '-') negative = true;
    else if (letter == '.') point = true;
    else if (letter != ignore) {
      value = value * 10 + letter - '0';
      if (point) place *= 10;
    }
    read();
  }
  return (negative ? -value : value) / place;
}

long Stream::parseInt(LookaheadMode lookahead, char ignore) { return (long)number(lookahead, ignore, false); }
float Stream::parseFloat(LookaheadMode lookahead, char ignore) { return (float)number(lookahead, ignore, true); }

size_t Stream::readBytes(char *to, size_t count) {
  size_t done = 0;
  for (int letter; done < count && (letter = timedRead()) >= 0;) to[done++] = letter;
  return done;
}

size_t Stream::readBytesUntil(char terminator, char *to, size_t count) {
  size_t done = 0;
  for (int letter; done < count && (letter = timedRead()) >= 0 && letter != terminator;) to[done++] = letter;
  return done;
}

String Stream::readString() {
  String text;
  for (int letter; (letter = timedRead()) >= 0;) text += (char)letter;
  return text;
}

String Stream::readStringUntil(char terminator) {
  String text;
  for (int letter; (letter = timedRead()) >= 0 && letter != terminator;) text += (char)letter;
  return text;
}
