% Asks a graph the questions that KnowRob asks, with SWI-Prolog's semantic-web library.
%
% Usage: swipl tools/knowrob/questions.pl GRAPH...
%
% KnowRob's names and meanings (its src/model/SOMA.pl): object_dimensions has the depth along x, the width along y and
% the height along z, metres, by ROS's REP 103; object_shape_type and object_mesh_path follow the same regions. A
% relation holds if it is stated by its property, a subproperty or an inverse; a type is stated, or a superclass of one.
%
% Prints one line for each answer, fields separated by tabs:
%   loaded      FILE       TRIPLES
%   dimensions  OBJECT     DEPTH  WIDTH  HEIGHT
%   mesh        OBJECT     FILE
%   pose        OBJECT     FRAME  DATA
%   supported   OBJECT     SUPPORT
%   ontop       OBJECT     SUPPORT
%   contains    CONTAINER  OBJECT
%   type        OBJECT     CLASS

:- use_module(library(semweb/rdf11)).
:- use_module(library(semweb/rdf_ntriples)).
:- use_module(library(semweb/turtle)).

:- rdf_register_prefix(soma, 'http://www.ease-crc.org/ont/SOMA.owl#').
:- rdf_register_prefix(dul, 'http://www.ontologydesignpatterns.org/ont/dul/DUL.owl#').
:- rdf_register_prefix(usd, 'https://ease-crc.org/ont/USD.owl#').

:- rdf_meta holds(r, r, o).

:- initialization(main, main).

main :-
    current_prolog_flag(argv, Files),
    forall(member(File, Files), load(File)),
    forall(distinct(Row, answer(Row)), say(Row)).

load(File) :-
    rdf_load(File, [graph(File), silent(true)]),
    rdf_statistics(triples_by_graph(File, Count)),
    say([loaded, File, Count]).

say(Row) :-
    atomic_list_concat(Row, '\t', Line),
    writeln(Line).

answer([dimensions, Object, Depth, Width, Height]) :-
    object_dimensions(Object, Depth, Width, Height).
answer([mesh, Object, File]) :-
    object_mesh_path(Object, File).
answer([pose, Object, Frame, Data]) :-
    object_pose(Object, Frame, Data).
answer([supported, Object, Support]) :-
    holds(Object, soma:isSupportedBy, Support).
answer([ontop, Object, Support]) :-
    holds(Object, soma:isOntopOf, Support).
answer([contains, Container, Object]) :-
    holds(Container, soma:containsObject, Object).
answer([type, Object, Class]) :-
    rdf(Object, rdf:type, usd:'Prim'),
    has_type(Object, Class).

object_dimensions(Object, Depth, Width, Height) :-
    shape_region(Object, Region),
    holds(Region, soma:hasDepth, Depth^^_),
    holds(Region, soma:hasWidth, Width^^_),
    holds(Region, soma:hasHeight, Height^^_).

object_mesh_path(Object, File) :-
    shape_region(Object, Region),
    holds(Region, soma:hasFilePath, File^^_).

shape_region(Object, Region) :-
    holds(Object, soma:hasShape, Shape),
    holds(Shape, dul:hasRegion, Region).

object_pose(Object, Frame, Data) :-
    holds(Object, soma:hasLocalization, Place),
    holds(Place, dul:hasRegion, Region),
    holds(Region, soma:hasReferenceFrame, Frame^^_),
    holds(Region, soma:hasPositionData, Data^^_).

has_type(Object, Class) :-
    rdf(Object, rdf:type, Stated),
    rdf_reachable(Stated, rdfs:subClassOf, Class),
    rdf_is_iri(Class).

holds(Subject, Property, Object) :-
    rdf_has(Subject, Property, Object).
holds(Subject, Property, Object) :-
    inverse(Property, Inverse),
    rdf_has(Object, Inverse, Subject).

inverse(Property, Inverse) :- rdf(Property, owl:inverseOf, Inverse).
inverse(Property, Inverse) :- rdf(Inverse, owl:inverseOf, Property).
