% Asks a graph what a robot asks its semantic map, with SWI-Prolog's semantic-web library, on which KnowRob is built.
%
%   swipl integrations/knowrob/questions.pl GRAPH... QUESTION [NAME...]     prints one line for each answer
%   swipl -l integrations/knowrob/questions.pl                              for ?- load('kitchen.ttl'). ?- on(X, Y).
%
% A name is a label, a prim path or an IRI; without it, all answers are printed. Fields are separated by tabs.
% Graphs are in the profile soma. Lengths are in metres, orientations are quaternions x y z w.

:- use_module(library(semweb/rdf11)).
:- use_module(library(semweb/rdf_ntriples)).
:- use_module(library(semweb/turtle)).
:- use_module(library(apply)).
:- use_module(library(lists)).
:- use_module(library(solution_sequences)).

:- rdf_register_prefix(soma, 'http://www.ease-crc.org/ont/SOMA.owl#').
:- rdf_register_prefix(dul, 'http://www.ontologydesignpatterns.org/ont/dul/DUL.owl#').
:- rdf_register_prefix(usd, 'https://ease-crc.org/ont/USD.owl#').
:- rdf_register_prefix(knowrob, 'http://knowrob.org/kb/knowrob.owl#').
:- rdf_register_prefix(u2k, 'https://w3id.org/usd2kg#').

:- rdf_meta holds(r, r, o), relation_property(?, r), has_type(r, r), measure(r, r, r, r, -), joint_number(r, r, r, -).

:- initialization(main, main).

% question(Name, Kinds of its arguments, Goal, Fields of an answer)
question(on, [thing(Support)], on(Object, Support, Gap), [Object, Support, Gap]).
question(supports, [thing(Object)], supports(Support, Object), [Object, Support]).
question(inside, [thing(Container)], inside(Object, Container), [Object, Container]).
question(may_contain, [thing(Object)], may_contain(Container, Object), [Object, Container]).
question(instances, [class(Class)], instance(Object, Class), [Object, Class]).
question(where, [thing(Object)], object_pose(Object, Frame, P, Q), [Object, Frame, P, Q]).
question(transform, [thing(Object)], transform(Object, Frame, Child, P, Q), [Frame, Child, P, Q]).
question(nearest, [class(Class), thing(Object)], nearest(Class, Object, Found, Gap), [Object, Found, Gap]).
question(room, [thing(Object)], room(Object, Room), [Object, Room]).
question(parts, [thing(Whole)], part(Part, Whole), [Part, Whole]).
question(size, [thing(Object)], object_dimensions(Object, Depth, Width, Height), [Object, Depth, Width, Height]).
question(relation, [thing(First), thing(Second)], relation(First, Name, Second), [First, Name, Second]).
question(joints, [thing(Object)], joint(Object, Joint, Min, Max, Position), [Object, Joint, Min, Max, Position]).
question(mesh, [thing(Object)], object_mesh_path(Object, File), [Object, File]).

% ---- Questions

%! on(?Object, ?Support, ?Gap): the object rests on the support; Gap is negative if they overlap.
on(Object, Support, Gap) :-
    holds(Object, soma:isOntopOf, Support),
    measure(Object, soma:isOntopOf, Support, u2k:gap, Gap).

on(Object, Support) :-
    holds(Object, soma:isOntopOf, Support).

%! supports(?Support, ?Object): the object rests on or in the support, directly or by other objects.
supports(Support, Object) :-
    distinct(Object, carrier(Object, _)),
    distinct(Support, carriers(Object, Support)).

:- table carriers/2.

carriers(Object, Support) :- carrier(Object, Support).
carriers(Object, Support) :- carrier(Object, Carrier), carriers(Carrier, Support).

carrier(Object, Support) :- holds(Object, soma:isSupportedBy, Support).
carrier(Object, Support) :- inside(Object, Support).

inside(Object, Container) :-
    holds(Container, soma:containsObject, Object).
inside(Object, Container) :-
    holds(Object, soma:isInsideOf, Container).

%! may_contain(?Container, ?Object): a designed container with a box that the box of the object fits into, along axes.
may_contain(Container, Object) :-
    object_extents(Object, Small),
    has_type(Container, soma:'DesignedContainer'),
    Container \== Object,
    object_extents(Container, Large),
    maplist(<, Small, Large).

%! instance(?Object, ?Class): the class is stated, or a superclass of the stated one.
instance(Object, Class) :-
    rdf(Object, rdf:type, usd:'Prim'),
    has_type(Object, Class).

%! object_pose(?Object, ?Frame, ?Position, ?Orientation): lists of numbers.
object_pose(Object, Frame, [X, Y, Z], [QX, QY, QZ, QW]) :-
    holds(Object, soma:hasLocalization, Place),
    holds(Place, dul:hasRegion, Region),
    holds(Region, soma:hasReferenceFrame, Frame^^_),
    holds(Region, soma:hasPositionData, Data^^_),
    numbers(Data, [X, Y, Z, QX, QY, QZ, QW]).

%! transform(?Object, ?Frame, ?Child, ?Position, ?Orientation): as usd2kg graph export --to tf writes it.
transform(Object, Frame, Child, Position, Orientation) :-
    object_pose(Object, _, AtWorld, TurnWorld),
    frame_id(Object, Child),
    (   holds(Whole, soma:hasPhysicalComponent, Object),
        object_pose(Whole, _, AtWhole, TurnWhole)
    ->  frame_id(Whole, Frame),
        relative(AtWorld, TurnWorld, AtWhole, TurnWhole, Position, Orientation)
    ;   Frame = map,
        Position = AtWorld,
        Orientation = TurnWorld
    ).

%! nearest(?Class, ?Object, ?Found, ?Gap): the instance of the class with the smallest distance between boxes.
nearest(Class, Object, Found, Gap) :-
    object_box(Object, Box),
    findall(Distance-Other, other_instance(Class, Object, Box, Other, Distance), Pairs),
    keysort(Pairs, [Gap-Found|_]).

other_instance(Class, Object, Box, Other, Distance) :-
    distinct(Other, instance(Other, Class)),
    Other \== Object,
    object_box(Other, OtherBox),
    box_gap(Box, OtherBox, Distance).

room(Object, Room) :-
    holds(Object, u2k:inRoom, Room).

%! part(?Part, ?Whole): directly, or a part of a part.
part(Part, Whole) :-
    distinct(Whole, holds(Whole, soma:hasPhysicalComponent, _)),
    rdf_reachable(Whole, soma:hasPhysicalComponent, Part),
    Part \== Whole,
    rdf(Part, rdf:type, usd:'Prim').

%! object_dimensions(?Object, ?Depth, ?Width, ?Height): along x, y and z, as KnowRob's predicate of this name.
object_dimensions(Object, Depth, Width, Height) :-
    shape_region(Object, Region),
    holds(Region, soma:hasDepth, Depth^^_),
    holds(Region, soma:hasWidth, Width^^_),
    holds(Region, soma:hasHeight, Height^^_).

object_mesh_path(Object, File) :-
    shape_region(Object, Region),
    holds(Region, soma:hasFilePath, File^^_).

%! joint(?Object, ?Joint, ?Min, ?Max, ?Position): of the object or between it and another; `-` for what is not stated.
%  Radians or metres. Whether a door is open follows from the position, which few stages state.
joint(Object, Joint, Min, Max, Position) :-
    distinct(Object-Joint, joint_of(Object, Joint)),
    joint_number(Joint, soma:hasJointLimit, soma:hasJointPositionMin, Min),
    joint_number(Joint, soma:hasJointLimit, soma:hasJointPositionMax, Max),
    joint_number(Joint, soma:hasJointState, soma:hasJointPosition, Position).

joint_of(Object, Joint) :- holds(Joint, soma:hasParentLink, Object).
joint_of(Object, Joint) :- holds(Joint, soma:hasChildLink, Object).
joint_of(Object, Joint) :- holds(Object, soma:hasPhysicalComponent, Joint), rdf(Joint, u2k:definingPrim, _).

joint_number(Joint, Part, Property, Number) :-
    (   rdf(Joint, Part, Node),
        rdf(Node, Property, Value^^_)
    ->  Number = Value
    ;   Number = '-'
    ).

%! relation(?First, ?Name, ?Second): the first is NAME the second; in both directions if both are given.
relation(First, Name, Second) :-
    relation_property(Name, Property),
    holds(First, Property, Second).

relation_property(on, soma:isOntopOf).
relation_property(inside, soma:isInsideOf).
relation_property(attached_to, u2k:attachedTo).
relation_property(above, knowrob:isAboveOf).
relation_property(below, knowrob:isBelowOf).
relation_property(touching, dul:hasCommonBoundary).
relation_property(next_to, knowrob:isNextTo).
relation_property(near, dul:nearTo).
relation_property(left_of, knowrob:isLeftOf).
relation_property(right_of, knowrob:isRightOf).
relation_property(in_front_of, knowrob:isInFrontOf).
relation_property(behind, knowrob:isBehindOf).
relation_property(in_room, u2k:inRoom).
relation_property(connects, u2k:connects).
relation_property(has_part, soma:hasPhysicalComponent).

% ---- Statements

%! holds(?Subject, ?Property, ?Object): stated by the property, a subproperty or an inverse.
holds(Subject, Property, Object) :-
    rdf_has(Subject, Property, Object).
holds(Subject, Property, Object) :-
    inverse(Property, Inverse),
    rdf_has(Object, Inverse, Subject).

inverse(Property, Inverse) :- rdf(Property, owl:inverseOf, Inverse).
inverse(Property, Inverse) :- rdf(Inverse, owl:inverseOf, Property).

%! measure(+Subject, +Property, +Object, +Number, -Value): of the annotation of a statement; `-` without it.
measure(Subject, Property, Object, Number, Value) :-
    (   rdf(Axiom, owl:annotatedSource, Subject),
        rdf(Axiom, owl:annotatedProperty, Property),
        rdf(Axiom, owl:annotatedTarget, Object),
        rdf(Axiom, Number, Found^^_)
    ->  Value = Found
    ;   Value = '-'
    ).

has_type(Object, Class) :-
    rdf(Object, rdf:type, Stated),
    rdf_reachable(Stated, rdfs:subClassOf, Class),
    rdf_is_iri(Class).

shape_region(Object, Region) :-
    holds(Object, soma:hasShape, Shape),
    holds(Shape, dul:hasRegion, Region).

% ---- Geometry

%! object_extents(?Object, -Extents): the three extents of the box, the smallest first.
object_extents(Object, Extents) :-
    object_dimensions(Object, Depth, Width, Height),
    msort([Depth, Width, Height], Extents).

%! object_box(?Object, -Box): pairs of lower and upper bounds along x, y and z.
object_box(Object, Box) :-
    object_dimensions(Object, Depth, Width, Height),
    shape_region(Object, Region),
    rdf(Region, u2k:boxCenter, Text^^_),
    numbers(Text, Center),
    maplist(bounds, Center, [Depth, Width, Height], Box).

bounds(Center, Extent, Lower-Upper) :-
    Lower is Center - Extent / 2,
    Upper is Center + Extent / 2.

box_gap(First, Second, Gap) :-
    maplist(axis_gap, First, Second, [X, Y, Z]),
    Gap is sqrt(X * X + Y * Y + Z * Z).

axis_gap(Lower-Upper, OtherLower-OtherUpper, Gap) :-
    Gap is max(0, max(Lower - OtherUpper, OtherLower - Upper)).

%! relative(+Position, +Orientation, +OfWhole, +TurnOfWhole, -Relative, -Turn): one frame seen from another.
relative([X, Y, Z], Orientation, [OX, OY, OZ], [QX, QY, QZ, QW], [RX, RY, RZ], Turn) :-
    maplist([A, B]>>(B is -A), [QX, QY, QZ], [IX, IY, IZ]),
    Inverse = [IX, IY, IZ, QW],
    maplist([A, B, C]>>(C is A - B), [X, Y, Z], [OX, OY, OZ], [DX, DY, DZ]),
    product(Inverse, [DX, DY, DZ, 0], Half),
    product(Half, [QX, QY, QZ, QW], [RX, RY, RZ, _]),
    product(Inverse, Orientation, Turn).

product([AX, AY, AZ, AW], [BX, BY, BZ, BW], [X, Y, Z, W]) :-
    X is AW * BX + AX * BW + AY * BZ - AZ * BY,
    Y is AW * BY - AX * BZ + AY * BW + AZ * BX,
    Z is AW * BZ + AX * BY - AY * BX + AZ * BW,
    W is AW * BW - AX * BX - AY * BY - AZ * BZ.

numbers(Text, Numbers) :-
    split_string(Text, " ", " ", Words),
    maplist([Word, Number]>>number_string(Number, Word), Words, Numbers).

% ---- Names

%! thing(+Name, -Object): by label, prim path or IRI.
thing(Name, Name) :-
    rdf(Name, u2k:primPath, _).
thing(Name, Object) :-
    rdf(Object, u2k:primPath, Name^^xsd:string).
thing(Name, Object) :-
    rdf(Object, rdfs:label, Name^^xsd:string),
    rdf(Object, u2k:primPath, _).

%! class(+Name, -Class): by local name, label or IRI.
class(Name, Class) :-
    distinct(Class, (has_type(_, Class), class_name(Class, Name))).

class_name(Class, Class).
class_name(Class, Name) :-
    rdf_global_id(_:Name, Class).
class_name(Class, Name) :-
    rdf(Class, rdfs:label, Label),
    literal_text(Label, Name).

literal_text(Text@_, Name) :- !, atom_string(Name, Text).
literal_text(Text^^_, Name) :- atom_string(Name, Text).

%! frame_id(?Object, -Frame): of the prim path, without characters that tf2 refuses; usd2kg writes the same.
frame_id(Object, Frame) :-
    rdf(Object, u2k:primPath, Path^^_),
    string_codes(Path, [0'/|Codes]),
    phrase(escaped(Codes), Escaped),
    atom_codes(Frame, Escaped).

escaped([]) --> [].
escaped([Code|Codes]) -->
    (   { is_plain(Code), \+ looks_escaped(Code, Codes) }
    ->  [Code]
    ;   { hexadecimal(Code, Digits) },
        "_u", Digits, "_"
    ),
    escaped(Codes).

is_plain(Code) :- Code < 128, ( code_type(Code, csym) ; Code == 0'/ ), !.

% Only the underscore that would begin an escape is escaped.
looks_escaped(0'_, [0'u, A, B, C, D|_]) :- maplist(is_digit16, [A, B, C, D]).

is_digit16(Code) :- memberchk(Code, `0123456789ABCDEF`).

hexadecimal(Code, Digits) :-
    format(codes(Short), '~16R', [Code]),
    length(Short, Length),
    Missing is max(0, 4 - Length),
    length(Zeros, Missing),
    maplist(=(0'0), Zeros),
    append(Zeros, Short, Digits).

% ---- Program

main :-
    current_prolog_flag(argv, Arguments),
    (   append(Files, [Name|Words], Arguments),
        question(Name, Kinds, Goal, Fields)
    ->  maplist(load, Files),
        ask(Words, Kinds, Goal, Fields)
    ;   findall(Name, question(Name, _, _, _), Names),
        atomic_list_concat(Names, ', ', Text),
        complain('expected GRAPH... QUESTION [NAME...], with one of the questions ~w', [Text])
    ).

load(File) :-
    rdf_load(File, [graph(File), silent(true)]).

ask(Words, Kinds, Goal, Fields) :-
    findall(Fields, (bind(Words, Kinds), call(Goal)), Unsorted),
    sort(Unsorted, Answers),
    maplist(say, Answers),
    (   Answers == [], member(Word, Words), \+ thing(Word, _), \+ class(Word, _)
    ->  complain('~w: neither an object nor a class in the graph', [Word])
    ;   true
    ).

%! bind(+Words, +Kinds): a variable without a word stays free.
bind([], _).
bind([Word|Words], [Kind|Kinds]) :-
    Kind =.. [Name, Value],
    distinct(Value, call(Name, Word, Value)),
    bind(Words, Kinds).

say(Fields) :-
    maplist(shown, Fields, Texts),
    atomic_list_concat(Texts, '\t', Line),
    writeln(Line).

shown(Numbers, Text) :- is_list(Numbers), !, maplist(shown, Numbers, Texts), atomic_list_concat(Texts, ' ', Text).
shown(Number, Text) :- number(Number), !, Text is round(Number * 1.0e6) / 1.0e6.
shown(Text, Text) :- string(Text), !.
shown(Iri, Path) :- rdf(Iri, u2k:primPath, Path^^_), !.
shown(Iri, Path) :- rdf(Iri, u2k:definingPrim, Path^^_), !.
shown(Iri, Label) :- rdf(Iri, rdf:type, u2k:'DerivedRoom'), rdf(Iri, rdfs:label, Label^^_), !.
shown(Atom, Atom).

complain(Format, Arguments) :-
    format(user_error, Format, Arguments),
    nl(user_error),
    halt(1).
