% What SWI-Prolog is asked in the benchmarks of the database. It reads goals, and answers each with one line.

:- dynamic parent/2, edge/2, asked/1.

:- table reach/2, path/2.

reach(X, Y) :- edge(X, Y).
reach(X, Y) :- reach(X, Z), edge(Z, Y).

path(X, Y) :- edge(X, Y).
path(X, Y) :- path(X, Z), path(Z, Y).

serve :-
    read(Goal),
    (   Goal == end_of_file
    ->  halt
    ;   call(Goal),
        flush_output,
        serve
    ).

% fill(N): a chain of N facts, and every Nth/1000 of them to be asked for.
fill(Count) :-
    forall(between(1, Count, I), fill_one(I)),
    Step is max(1, Count // 1000),
    forall(between(0, 999, K), ask_later(K * Step)),
    findall(Name, asked(Name), Names),
    nb_setval(names, Names).

fill_one(I) :-
    J is I - 1,
    atom_concat('node-', J, One),
    atom_concat('node-', I, Other),
    assertz(parent(One, Other)).

ask_later(Expression) :-
    I is Expression,
    atom_concat('node-', I, Name),
    assertz(asked(Name)).

edges :-
    abolish_all_tables,
    retractall(edge(_, _)),
    read(Pairs),
    forall(member(X-Y, Pairs), assertz(edge(X, Y))).

% sample(Work, N): the seconds of processor time that N times WORK takes.
sample(Work, Count) :-
    statistics(cputime, Begin),
    forall(between(1, Count, _), work(Work)),
    statistics(cputime, End),
    Seconds is End - Begin,
    writeln(Seconds).

answer(Work) :-
    count(Work, Count),
    writeln(Count).

work(look_up) :-
    nb_getval(names, Names),
    forall(member(Name, Names), parent(Name, _)).
work(look_up_list) :-
    nb_getval(names, Names),
    forall(member(Name, Names), findall(X, parent(Name, X), _)).
work(join) :-
    forall((parent(_, Y), parent(Y, _)), true).
work(join_list) :-
    findall(X-Y-Z, (parent(X, Y), parent(Y, Z)), _).
work(reach(X)) :-
    abolish_all_tables,
    forall(reach(X, _), true).
work(reach) :-
    abolish_all_tables,
    forall(reach(_, _), true).
work(path(X)) :-
    abolish_all_tables,
    forall(path(X, _), true).

count(Work, Count) :-
    memberchk(Work, [look_up, look_up_list]),
    !,
    nb_getval(names, Names),
    aggregate_all(count, (member(Name, Names), parent(Name, _)), Count).
count(Work, Count) :-
    memberchk(Work, [join, join_list]),
    !,
    aggregate_all(count, (parent(_, Y), parent(Y, _)), Count).
count(reach(X), Count) :-
    aggregate_all(count, reach(X, _), Count).
count(reach, Count) :-
    aggregate_all(count, reach(_, _), Count).
count(path(X), Count) :-
    aggregate_all(count, path(X, _), Count).
