/* == RM: source_selector.cpp ======================================================= */
inline feed(r) {
  if :: STANDS(r) -> calls = calls | BIT(r); told_to_stand_by = told_to_stand_by | BIT(r)
     :: else -> inputs = inputs | BIT(r); told_to_stand_by = told_to_stand_by & ~BIT(r) fi
}
inline tell_roles(k) { /* announce_roles */
  k = 1;
  do :: k <= SESSIONS ->
        if :: ((in_use & BIT(k)) && (((told_to_stand_by & BIT(k)) != 0) != (STANDS(k) != 0))) -> feed(k) :: else fi; k++
     :: else -> break od; k = 0
}
inline rm_end(r, k) { /* on_end */
  if :: (sources & BIT(r)) ->
     sources = sources & ~BIT(r);
     told_to_stand_by = told_to_stand_by & ~BIT(r);
     if :: (in_use & BIT(r)) -> in_use = in_use & ~BIT(r);
           if :: in_use == 0 -> if :: MUTANT != 4 -> to_wd!DISARM(r) :: else fi;
                 assert(!own_runs && client_remote);
                 own_runs = (MUTANT != 15); client_remote = (MUTANT == 23);
#if CHAIN
                 if :: MUTANT == 32 -> OTHER.own_runs_ = 1 :: else fi
#endif
              :: else -> tell_roles(k);
                 if :: (watched == r && MUTANT != 3) -> k = 1;
                       do :: ((in_use & BIT(k)) && !STANDS(k)) -> break
                          :: (in_use >> (k + 1)) -> k++ od;
                       watched = k; to_wd!ARM(k); k = 0
                    :: else fi
           fi
        :: else fi
     :: else fi
}
#define IS_SILENT(b) (!GIVES(session[b]) && !STANDS(session[b]) && !(results & BIT(session[b])))
/* give_up_silent */
#define GIVE_UP(b) atomic { session[b] != 0 && at[b] == REMOTE && (in_use & BIT(session[b])) && (in_use & ~BIT(session[b])) && \
     len(to_rm) == 0 && len(to_sr) == 0 && (IS_SILENT(b) || left > 0) -> \
     if :: !IS_SILENT(b) -> FAULT :: else fi; to_sr!VIOLATION_OF_ONE(session[b]) }
proctype RM(byte v) {
  byte r, k; mtype m;
end: do
  :: atomic { len(to_sr) < 6 && len(to_wd) < 6 && nempty(to_rm) -> to_rm?m, r;
     if
     :: m == AWAIT -> sources = sources | BIT(r); feed(r)
     :: m == RESULT ->
        if :: ((sources & BIT(r)) || MUTANT == 22) ->
           if :: !(in_use & BIT(r)) -> /* begin */
                 if :: in_use == 0 -> assert(own_runs && !client_remote);
                       own_runs = 0; watched = r; client_remote = 1;
                       if :: MUTANT != 17 -> to_wd!ARM(r) :: else fi
                    :: else fi;
                 in_use = in_use | BIT(r); to_sr!FIRST(r); tell_roles(k)
              :: else -> if :: (STANDS(r) && !called[PROVIDER(BOOT(r))]) -> feed(r) :: else fi
           fi;
           assert(client_remote && !own_runs) /* used */
        :: else fi
     :: m == LATE -> if :: (in_use == BIT(r)) -> to_wd!LATE(watched) :: else fi
     :: m == BAD -> if :: (sources & BIT(r)) -> rm_end(r, k); to_sr!IMPLAUSIBLE(r) :: else fi
     :: m == END -> if :: MUTANT != 24 -> rm_end(r, k) :: else fi
     :: m == STANDS_BY -> standby = r; tell_roles(k)
     fi; m = 0; r = 0; CHECK }
#if BOOTS > 1
  :: GIVE_UP(0) :: GIVE_UP(1)
#endif
#if BOOTS > 2
  :: GIVE_UP(2)
#endif
  /* a cycle was not answered in time: the standby is called */
  :: atomic { left > 0 && standby != 0 && session[standby - 1] != 0 && (in_use & BIT(session[standby - 1])) && STANDS(session[standby - 1]) ->
     FAULT; r = session[standby - 1]; feed(r); r = 0 }
  od
}

/* == WD: watchdog.cpp ============================================================== */
#define GOES_ON1(p) (alive[p] && !mute[p] && runs[p] != 0 && fed[p] && GETS_INPUTS && (in_use & BIT(runs[p])))
#define GOES_ON ((results & in_use) || GOES_ON1(0) || GOES_ON1(1))
proctype WD(byte v) {
  byte r; mtype m;
end: do
  :: atomic { len(to_sr) < 6 && nempty(to_wd) -> to_wd?m, r;
     if :: m == ARM -> armed = r
        :: m == LATE -> if :: (armed == r && r != 0) -> to_sr!VIOLATION(r); armed = 0 :: else fi
        :: m == DISARM -> if :: armed == r -> armed = 0 :: else fi
     fi; m = 0; r = 0; CHECK }
  :: atomic { MUTANT != 13 && MAY_COME_HOME && len(to_sr) < 6 && armed != 0 && len(to_wd) == 0 && (left > 0 || (!GOES_ON && len(to_rm) == 0 && len(to_sr) == 0)) ->
     if :: (GOES_ON || len(to_rm) != 0 || len(to_sr) != 0) -> FAULT :: else fi; to_sr!VIOLATION(armed); armed = 0; CHECK }
  od
}

