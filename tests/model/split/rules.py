def to_copy(t, P, C):
    @t.rule
    def Copy(group: P.Group, made: C.Group):
        made.name = group.name
