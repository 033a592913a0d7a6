CREATE TABLE choice(part_id TEXT NOT NULL, title TEXT NOT NULL, library TEXT NOT NULL, count INTEGER NOT NULL CHECK (count > 0),
  last_used TEXT NOT NULL, PRIMARY KEY (part_id, title, library)) WITHOUT ROWID;
INSERT INTO choice VALUES ('p', 't', 'A', 3, '2026-11-20');
PRAGMA application_id=1381189705;
PRAGMA user_version=1;
