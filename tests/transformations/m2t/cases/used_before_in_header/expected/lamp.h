#define SHORT 40

// So many flashes, each followed by a rest.
int32_t shine(int32_t ms);
void rest(int32_t ms);
void flash(int32_t times)
{
  for(int32_t i = 0; i < times; i++)
  {
    shine(SHORT);
    rest(2L * SHORT);
  }
}

int32_t shine(int32_t ms)
{
  high(255 /* P3 is not wired yet */);
  pause(ms);
  low(255 /* P3 is not wired yet */);
  return ms;
}

void rest(int32_t ms) { pause(ms); }
